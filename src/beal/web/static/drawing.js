// The vehicle to scale along its axis, bent by a motion, at the pace of the screen.

import { short } from "./numbers.js";

const SVG = "http://www.w3.org/2000/svg";
const HIGH = 180, MIDDLE = 92, SIDE = 70; // of the drawing, which is as wide as its place
const HALF = 17; // half the width of the stiffest section
const BEND = 40; // largest deflection
const PERIOD = 1.7; // s on the screen
const PERIODS = 4; // after which a motion that grows begins anew
const GROWTH = 1.5; // the largest that is drawn until then, as a power of e: stronger growth would hide how it begins

export class Drawing {
  #frame = null;
  #began = 0;

  constructor(svg, moved) {
    Object.assign(this, { svg, moved, running: !matchMedia("(prefers-reduced-motion: reduce)").matches, wide: 1000 });
    svg.addEventListener("pointermove", (event) => this.#drag(event));
    new ResizeObserver(() => this.#fit()).observe(svg);
    for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, () => this.#drop());
  }

  show(vehicle, shapes, mode) {
    Object.assign(this, { vehicle, shapes, mode });
    const parts = JSON.stringify([vehicle.stages, vehicle.joints, vehicle.point_masses, vehicle.sensors, vehicle.forces, vehicle.tanks, vehicle.support]);
    if (parts !== this.parts) {
      this.parts = parts;
      this.#build();
    }
    if (!this.#frame) this.#frame = requestAnimationFrame((time) => this.#move(time));
  }

  play(running) {
    this.running = running;
    if (running && !this.#frame) this.#frame = requestAnimationFrame((time) => this.#move(time));
  }

  #fit() {
    const { width, height } = this.svg.getBoundingClientRect();
    this.wide = Math.max((HIGH * width) / Math.max(height, 1), 760);
    this.svg.setAttribute("viewBox", `0 0 ${this.wide} ${HIGH}`);
    if (this.vehicle) this.#build();
  }

  get #scale() { return (this.wide - 2 * SIDE) / this.vehicle.length; }
  #x(station) { return SIDE + this.#scale * station; }

  #build() {
    const { vehicle } = this;
    const focused = document.activeElement?.dataset?.joint;
    this.svg.replaceChildren();
    const line = this.#add("line", { class: "axis", x1: SIDE - 30, x2: this.wide - SIDE + 30, y1: MIDDLE, y2: MIDDLE });
    line.setAttribute("aria-hidden", "true");
    const stiffest = Math.max(...vehicle.stages.flatMap(({ bending_stiffness: EI }) => (EI === "rigid" ? [] : EI.value ?? [EI])), 1e-300);
    this.bodies = vehicle.stages.map((stage) => ({ stage, widths: widths(stage, stiffest), path: this.#add("path", { class: "body" }, stage.name) }));
    this.riders = [];
    const heaviest = vehicle.mass;
    this.tanks = vehicle.tanks.map((tank) => ({ tank, path: this.#add("path", { class: "tank" }, `tank ${tank.name}`) }));
    for (const mass of vehicle.point_masses) this.#rider(mass.station, "circle", { class: "mass", r: 4 + 26 * Math.sqrt(mass.mass / heaviest) }, `mass ${mass.name} ${short(mass.mass)}`);
    for (const sensor of vehicle.sensors) this.#rider(sensor.station, "path", { class: "sensor", d: `M0 ${HALF + 3}l7 12h-14z` }, sensor.name, { y: HALF + 28, "text-anchor": "middle" });
    for (const force of vehicle.forces) this.#rider(force.station, "path", { class: "force", d: `M0 ${-HALF - 30}v20m-4 -7l4 8l4 -8z` }, force.name || `F(t), ${force.kind}`, beside(force.station < vehicle.length / 2));
    this.thrust = this.#add("path", { class: "thrust", d: "M6 0h58M4 0l15 -7v14z" }, "thrust");
    this.joints = vehicle.joints.map((joint, number) => this.#joint(joint, number));
    this.#support(vehicle.support.nose, 0, -1);
    this.#support(vehicle.support.tail, vehicle.length, 1);
    if (focused !== undefined) this.joints[focused]?.focus();
  }

  #add(tag, attributes, title = "") {
    const made = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    if (title) {
      const told = document.createElementNS(SVG, "title");
      told.textContent = title;
      made.append(told);
    }
    this.svg.append(made);
    return made;
  }

  #rider(station, tag, attributes, name, place = null) {
    const shape = this.#add(tag, attributes, `${name} at ${short(station)}`);
    const holder = this.#add("g", {});
    holder.append(shape);
    if (place) {
      const text = this.#add("text", { ...place, "aria-hidden": "true" });
      text.textContent = name;
      holder.append(text);
    }
    this.riders.push({ station, holder });
  }

  #joint(joint, number) {
    const rigid = joint.rotational_stiffness === "rigid" && joint.shear_stiffness === "rigid";
    const [low, high] = [this.vehicle.stages[number].from, this.vehicle.stages[number + 1].to];
    const made = this.#add("circle", {
      class: rigid ? "joint rigid" : "joint", r: 8, tabindex: 0, role: "slider", "data-joint": number,
      "aria-label": `station of joint ${number + 1}${joint.name ? `, ${joint.name}` : ""}`,
      "aria-valuemin": low, "aria-valuemax": high, "aria-valuenow": joint.station,
    }, `joint ${number + 1}: drag it, or use the arrow keys`);
    made.addEventListener("pointerdown", (event) => {
      this.dragged = number;
      this.svg.setPointerCapture(event.pointerId);
      event.preventDefault();
      made.focus();
    });
    made.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 5, PageDown: -5 }[event.key];
      if (!step) return;
      event.preventDefault();
      this.#place(number, this.vehicle.joints[number].station + (step * this.vehicle.length) / 100, true);
    });
    return made;
  }

  #drag(event) {
    if (this.dragged === undefined) return;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    this.#place(this.dragged, (point.x - SIDE) / this.#scale, false);
  }

  #drop() {
    if (this.dragged === undefined) return;
    this.dragged = undefined;
    this.moved(null);
  }

  #place(number, station, ended) {
    const [low, high] = [this.vehicle.stages[number].from, this.vehicle.stages[number + 1].to];
    const margin = 0.02 * (high - low);
    this.moved({ number, low, high, station: Math.min(Math.max(station, low + margin), high - margin) });
    if (ended) this.moved(null);
  }

  #support(end, station, side) {
    if (end === "free") return;
    const x = this.#x(station) + side * (end === "clamped" || end === "sliding" ? 2 : 0);
    const d = end === "pinned" ? `M${x} ${MIDDLE}l-10 20h20z` : end === "clamped" || end === "sliding"
      ? `M${x} ${MIDDLE - 30}v60${[-24, -12, 0, 12, 24].map((y) => `M${x} ${MIDDLE + y}l${side * 9} 8`).join("")}`
      : `M${x} ${MIDDLE + HALF}l6 4l-12 6l12 6l-12 6l6 4m-10 0h20`;
    this.#add("path", { class: "ground", d }, `${side < 0 ? "nose" : "tail"}: ${typeof end === "string" ? end : "springs"}`);
  }

  // Deflection over its largest, at a time on the screen.
  #amplitudes(time) {
    const { angular_frequency: omega, growth_rate: growth } = this.shapes;
    const [w, sigma] = [omega[this.mode], growth[this.mode]];
    const span = PERIODS * PERIOD;
    const t = (time - this.#began) / 1000;
    if (w < 1e-9 * Math.max(...omega, 1e-300)) { // divergence: it leaves and does not come back
      const share = (t % PERIOD) / PERIOD;
      return [Math.exp(3 * (share - 1)) * (sigma > 0 ? 1 : 0.3), 0];
    }
    const angle = (2 * Math.PI * t) / PERIOD;
    const most = GROWTH / span;
    const rate = Math.min(Math.max((sigma / w) * ((2 * Math.PI) / PERIOD), -most), most);
    const part = t % span;
    const size = Math.exp(rate > 0 ? rate * (part - span) : rate * part);
    return [size * Math.cos(angle), -size * Math.sin(angle)];
  }

  #move(time) {
    this.#frame = this.running ? requestAnimationFrame((next) => this.#move(next)) : null;
    const { shapes, vehicle, mode } = this;
    if (!shapes || mode === undefined) return;
    const [c, s] = this.#amplitudes(time);
    const bent = shapes.station.map((stations, stage) => stations.map((x, n) => [this.#x(x), MIDDLE - BEND * (c * shapes.real[mode][stage][n] + s * shapes.imag[mode][stage][n])]));
    this.bodies.forEach(({ widths, path }, stage) => path.setAttribute("d", outline(bent[stage], widths)));
    const at = (station) => {
      let stage = vehicle.stages.findIndex(({ to }) => station < to);
      if (stage < 0) stage = vehicle.stages.length - 1;
      const { from, to } = vehicle.stages[stage];
      const place = (bent[stage].length - 1) * Math.min((station - from) / (to - from), 1);
      const n = Math.min(Math.floor(place), bent[stage].length - 2);
      const [[x, y], [u, v]] = [bent[stage][n], bent[stage][n + 1]];
      return [x + (place - n) * (u - x), y + (place - n) * (v - y), Math.atan2(v - y, u - x)];
    };
    for (const { tank, path } of this.tanks) {
      const points = Array.from({ length: 13 }, (_, n) => at(tank.from + (n / 12) * (tank.to - tank.from)));
      path.setAttribute("d", outline(points, () => HALF / 3));
    }
    const degrees = 180 / Math.PI;
    for (const { station, holder } of this.riders) {
      const [x, y] = at(station);
      holder.setAttribute("transform", `translate(${x} ${y})`);
    }
    const [x, y, slope] = at(vehicle.thrust_station);
    this.thrust.setAttribute("transform", `translate(${x} ${y}) rotate(${vehicle.tangency * slope * degrees})`);
    this.thrust.style.display = vehicle.thrust_share ? "" : "none";
    this.joints.forEach((joint, number) => {
      const [a, b] = [bent[number].at(-1), bent[number + 1][0]];
      joint.setAttribute("cx", (a[0] + b[0]) / 2);
      joint.setAttribute("cy", (a[1] + b[1]) / 2);
    });
  }
}

// The place of a force's name: beside its arrow, towards the middle of the vehicle.
function beside(right) {
  return { x: right ? 9 : -9, y: -HALF - 18, "text-anchor": right ? "start" : "end" };
}

// Half widths go with EI^(1/4), as the radii of similar sections of one material do.
function widths(stage, stiffest) {
  const EI = stage.bending_stiffness;
  const length = stage.to - stage.from;
  return (share) => {
    if (EI === "rigid") return HALF;
    if (!EI.value) return HALF * (EI / stiffest) ** 0.25;
    const x = share * length;
    let n = EI.x.findIndex((end) => end > x);
    if (n < 0) n = EI.x.length - 1;
    n = Math.max(n, 1);
    const part = (x - EI.x[n - 1]) / (EI.x[n] - EI.x[n - 1] || 1);
    return HALF * ((EI.value[n - 1] + part * (EI.value[n] - EI.value[n - 1])) / stiffest) ** 0.25;
  };
}

function outline(points, half) {
  const last = points.length - 1;
  const above = [], below = [];
  points.forEach(([x, y], n) => {
    const [before, after] = [points[Math.max(n - 1, 0)], points[Math.min(n + 1, last)]];
    const angle = Math.atan2(after[1] - before[1], after[0] - before[0]);
    const width = Math.max(half(n / last), 1.5);
    above.push(`${(x + width * Math.sin(angle)).toFixed(1)} ${(y - width * Math.cos(angle)).toFixed(1)}`);
    below.push(`${(x - width * Math.sin(angle)).toFixed(1)} ${(y + width * Math.cos(angle)).toFixed(1)}`);
  });
  return `M${above.join("L")}L${below.reverse().join("L")}Z`;
}
