// Sliders, number fields and choices, one for each quantity of the vehicle, grouped by the part that it belongs to.

import { short } from "./numbers.js";

const STEPS = 1000;
const SELDOM = new Set(["rotary_inertia_per_length", "internal_damping", "external_damping", "foundation_stiffness",
  "rotational_damping", "shear_damping", "rotary_inertia", "scale", "gravity", "phase", "start", "line", "axial_force"]);

export class Controls {
  #fields = new Map();

  constructor(holder, state) {
    Object.assign(this, { holder, state });
  }

  // Built anew when the parts of the vehicle change; otherwise the values alone.
  show({ quantities, choices, vehicle }) {
    const shape = JSON.stringify([quantities.map(({ path, from, to }) => [path, from, to]), choices.map(({ path }) => path)]);
    if (shape !== this.shape) {
      this.shape = shape;
      this.#build(quantities, choices, vehicle);
    }
    for (const quantity of quantities) this.#fields.get(quantity.path).show(quantity.value);
    for (const choice of choices) this.#fields.get(choice.path).show(choice.value);
  }

  // Values that the state has, before the server has answered.
  follow(values) {
    for (const [path, value] of Object.entries(values)) this.#fields.get(path)?.show(value);
  }

  refuse(problems) {
    for (const mark of document.querySelectorAll("aside .error")) mark.textContent = "";
    for (const mark of document.querySelectorAll('aside [aria-invalid="true"]')) mark.removeAttribute("aria-invalid");
    return problems.filter(({ path, message }) => {
      const mark = document.querySelector(`aside .error[data-path="${CSS.escape(path)}"]`);
      if (!mark) return true;
      mark.textContent = message;
      mark.closest("details")?.setAttribute("open", "");
      mark.parentElement.querySelector("input.number, select")?.setAttribute("aria-invalid", "true");
      return false;
    });
  }

  #build(quantities, choices, vehicle) {
    const open = new Set([...this.holder.querySelectorAll("details[open]")].map((group) => group.dataset.part));
    const first = !this.holder.childElementCount;
    this.holder.replaceChildren();
    this.#fields.clear();
    const groups = new Map();
    for (const item of [...quantities, ...choices]) {
      const part = item.path === "stage.split" ? "joint[0]" : item.path.includes(".") ? item.path.slice(0, item.path.lastIndexOf(".")) : "vehicle";
      if (!groups.has(part)) groups.set(part, []);
      groups.get(part).push(item);
    }
    const order = ["joint", "thrust", "stage"];
    const rank = (part) => (order.indexOf(part.split(/[[.]/)[0]) + 1 || 9);
    for (const [part, items] of [...groups].sort((a, b) => rank(a[0]) - rank(b[0]))) {
      const group = element("details", { "data-part": part });
      group.open = first || !open.size ? (rank(part) < 9 && groups.size < 12 || rank(part) < 3) && !items[0].entry : open.has(part);
      group.append(element("summary", {}, title(part, vehicle)));
      const seldom = element("details", { "data-part": `${part}/more` });
      seldom.append(element("summary", {}, "more"));
      for (const item of items) {
        const field = item.options ? new Choice(item, this.state) : new Quantity(item, this.state);
        this.#fields.set(item.path, field);
        const rare = SELDOM.has(item.name) && !item.value || item.options && SELDOM.has(item.name)
          || part.startsWith("stage") && item.name === "shear_stiffness" && item.value === "inf";
        (rare ? seldom : group).append(field.row);
      }
      if (seldom.childElementCount > 1) group.append(seldom);
      this.holder.append(group);
    }
  }
}

class Quantity {
  constructor(quantity, state) {
    Object.assign(this, quantity);
    const id = `q-${this.path.replace(/\W+/g, "-")}`;
    const unit = this.unit ? ` [${this.unit.replaceAll("*", "\u00a0")}]` : "";
    this.row = element("div", { class: "field" });
    this.number = element("input", { class: "number", id, autocomplete: "off", "aria-describedby": `${id}-error` });
    this.slider = element("input", { type: "range", min: 0, max: STEPS, "aria-label": `${this.path}, slider`, tabindex: 0 });
    this.row.append(element("label", { for: id, title: this.path }, words(this.path, this.name) + unit), this.number, this.slider);
    if (this.may_be_rigid) {
      this.rigid = element("input", { type: "checkbox", "aria-label": `${this.path} rigid` });
      const label = element("label", { class: "rigid" });
      label.append(this.rigid, " rigid");
      this.row.append(label);
      this.rigid.addEventListener("change", () => { state.value(this.path, this.rigid.checked ? "inf" : this.last); state.keep(); });
    }
    this.row.append(element("p", { class: "error", id: `${id}-error`, "data-path": this.path }));
    this.last = Number.isFinite(this.value) && this.value !== null ? this.value : this.#at(STEPS * 0.6);
    this.slider.addEventListener("input", () => state.value(this.path, Number(this.#at(this.slider.valueAsNumber).toPrecision(6))));
    this.slider.addEventListener("change", () => state.keep());
    this.number.addEventListener("change", () => {
      this.shown = this.number.value;
      const text = this.number.value.trim();
      state.value(this.path, text === "" || Number.isNaN(Number(text)) ? text : Number(text));
      state.keep();
    });
  }

  #at(step) {
    const share = step / STEPS;
    return this.scale === "log" ? this.from * (this.to / this.from) ** share : this.from + share * (this.to - this.from);
  }

  show(value) {
    const rigid = value === "inf";
    if (typeof value === "number") {
      this.last = value;
      const share = this.scale === "log" ? Math.log(value / this.from) / Math.log(this.to / this.from) : (value - this.from) / (this.to - this.from);
      this.slider.value = Math.round(STEPS * Math.min(Math.max(share, 0), 1));
    }
    const typing = document.activeElement === this.number && this.number.value !== this.shown;
    if (!typing) this.number.value = this.shown = value === null ? "" : typeof value === "number" ? short(value, 6) : value;
    this.slider.setAttribute("aria-valuetext", this.number.value || "not given");
    this.slider.disabled = rigid;
    if (this.rigid) this.rigid.checked = rigid;
  }
}

class Choice {
  constructor(choice, state) {
    const id = `q-${choice.path.replace(/\W+/g, "-")}`;
    this.row = element("div", { class: "field plain" });
    this.select = element("select", { id });
    for (const option of new Set([...choice.options, choice.value])) this.select.append(element("option", {}, option));
    this.row.append(element("label", { for: id }, words(choice.path, choice.name)), this.select, element("p", { class: "error", "data-path": choice.path }));
    this.select.addEventListener("change", () => {
      state.set({ choices: { ...state.now.choices, [choice.path]: this.select.value } });
      state.keep();
    });
  }

  show(value) {
    this.select.value = value;
  }
}

function words(path, name) {
  return path === "stage.split" ? "place (share of the length)" : name.replaceAll("_", " ");
}

function title(part, vehicle) {
  const [, kind, index] = /^(\w+)(?:\[(\d+)\])?/.exec(part);
  const named = { stage: vehicle.stages, joint: vehicle.joints, sensor: vehicle.sensors, point_mass: vehicle.point_masses, tank: vehicle.tanks }[kind];
  const name = index !== undefined && named?.[index]?.name;
  const number = index === undefined ? "" : ` ${Number(index) + 1}`;
  const rest = part.slice(part.indexOf(".") + 1);
  const text = kind.replaceAll("_", " ") + number + (part.includes(".") ? ` ${rest.replaceAll("_", " ")}` : "") + (name ? `: ${name}` : "");
  return text[0].toUpperCase() + text.slice(1);
}

export function element(tag, attributes = {}, text = "") {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  return made;
}
