// The page: what is changed where, and what is asked and drawn then.

import { Latest, Refused, ask, read } from "./api.js";
import * as charts from "./charts.js";
import { Controls, element } from "./controls.js";
import { Drawing } from "./drawing.js";
import { Further } from "./further.js";
import { StabilityMap } from "./map.js";
import { named, parsed, short } from "./numbers.js";
import { State } from "./state.js";

const SLOW = 80; // ms of an answer, above which a draft comes first
const REST = 150; // ms without a change until the quantities are asked for again
const byId = (id) => document.getElementById(id);
const state = new State(changed);
const controls = new Controls(byId("controls"), state);
const drawing = new Drawing(byId("drawing"), placed);
const map = new StabilityMap(byId("map-progress"), byId("map-stop"), (axes, values) => {
  state.set({ values: { ...state.now.values, [axes[0].path]: values[0], [axes[1].path]: values[1] } });
  state.keep();
});
const further = new Further(byId("further-progress"), byId("further-stop"));
let model = null; // the last answers
let solved = null;
let finishing = null; // timers: for the verdict after a draft, the list of quantities, and the slower charts
let resting = null;
let waiting = null;

const question = () => {
  const { model, values, choices, formulation } = state.now;
  return { model, values, choices, formulation };
};

const models = new Latest("model", (answer, asked) => {
  if (JSON.stringify(asked) !== JSON.stringify(question())) return; // something has changed since, and is asked for
  model = answer;
  controls.show({ ...answer });
  byId("title").textContent = answer.vehicle.title;
  document.title = answer.vehicle.title ? `${answer.vehicle.title} - beal explorer` : "beal explorer";
  axesOffered();
  sensorsOffered();
  byId("over").querySelector('[value="gain"]').disabled = !answer.vehicle.control;
  slower();
}, refused);

const isNow = ({ to, ...asked }) => JSON.stringify(asked) === JSON.stringify({ ...question(), thrust: state.now.thrust });

const solutions = new Latest("solve", (answer, asked) => {
  if (drafts.took && !isNow(asked)) return; // a draft of something newer is drawn
  solved = answer;
  problems([]);
  verdict();
  curvesShown();
}, refused);

// Of a vehicle that takes its time, the curves come before the verdict.
const drafts = new Latest("draft", (answer, asked) => {
  solved = { ...solved, ...answer, critical: { critical_thrust: null } };
  problems([]);
  byId("verdict").classList.add("waiting");
  curvesShown();
  if (isNow(asked)) finishing = setTimeout(() => solutions.ask({ ...question(), thrust: state.now.thrust }), REST);
}, refused);

function curvesShown() {
  motionShown();
  charts.curve(solved, thrustNow());
  requestAnimationFrame(() => setTimeout(locus)); // once the curves are seen
  document.querySelector("main").classList.remove("stale");
}

const motions = new Latest("response", (answer) => {
  byId("response-error").textContent = "";
  const { sensor } = state.now;
  const growing = answer.growth_rate > 1e-6;
  byId("growth").textContent = growing ? `grows as exp(${short(answer.growth_rate, 4)} t)` : "does not grow";
  charts.motion(answer, sensor in answer.sensors ? sensor : Object.keys(answer.sensors)[0]);
}, (error) => {
  byId("response-error").textContent = error.message;
  charts.empty("response", "no response");
  charts.empty("phase", "no response");
});

const loci = new Latest("locus", (answer) => charts.gainLocus(answer, solved.vehicle.units), (error) => charts.empty("locus", error.message));

function changed(part) {
  const { now } = state;
  byId("undo").disabled = !state.undoable;
  byId("redo").disabled = !state.redoable;
  byId("formulation").value = now.formulation;
  byId("over").value = now.over;
  byId("start").value = String(now.start);
  if (!now.model) return;
  controls.follow(now.values);
  if ("further" in part || "sensor" in part || "start" in part || "duration" in part || "mode" in part && !("thrust" in part) && !("values" in part)) slower();
  if ("axes" in part && model) axesOffered();
  const vehicle = ["model", "values", "choices", "formulation", "thrust"].some((name) => name in part);
  if ("model" in part) model = null; // what belongs to the vehicle before
  if (vehicle) {
    const asked = { ...question(), thrust: now.thrust };
    if (solved && !("model" in part) && solutions.took > SLOW) drafts.ask({ ...asked, to: solved.curve.thrust.at(-1) });
    else {
      drafts.took = 0;
      solutions.ask(asked);
    }
    map.stop();
    further.stop();
    clearTimeout(finishing);
    clearTimeout(resting);
    resting = setTimeout(() => models.ask(question()), solved ? REST : 0);
  } else if (solved && "mode" in part) motionShown();
  if ("over" in part && solved) locus();
}

function refused(error) {
  document.querySelector("main").classList.add("stale");
  problems(error.problems);
}

function problems(list) {
  const left = controls.refuse(list);
  const box = byId("problem");
  box.hidden = !left.length;
  box.replaceChildren(...left.map(({ path, message }) => element("p", {}, path ? `${path}: ${message}` : message)));
}

function verdict() {
  const box = byId("verdict");
  const { margin, critical_thrust: P } = solved.critical;
  box.className = P === null ? "good" : margin === null ? "" : margin > 0 ? "good" : "bad";
  const [words, note] = box.children;
  words.textContent = solved.verdict.replace(`${solved.vehicle.title}: `, "").replace(/^./, (letter) => letter.toUpperCase()).replaceAll("^2", "²");
  note.textContent = [solved.searched, solved.convention].filter(Boolean).join("; ");
}

// The thrust of the motion shown: that of the state, else the nominal one.
function thrustNow() {
  return state.now.thrust ?? solved.vehicle.nominal_thrust ?? 0;
}

function motionShown() {
  const { shapes, vehicle, curve } = solved;
  const list = byId("shown");
  const names = ["the least stable", ...shapes.angular_frequency.map((_, n) => `mode ${n + 1}`)];
  if (list.options.length !== names.length) list.replaceChildren(...names.map((name, n) => element("option", { value: n }, name)));
  list.value = String(Math.min(state.now.mode, names.length - 1));
  const fastest = shapes.growth_rate.reduce((best, growth, n) => (growth > shapes.growth_rate[best] + 1e-9 ? n : best), 0);
  const mode = Number(list.value) ? Number(list.value) - 1 : fastest;
  drawing.show(vehicle, shapes, mode);
  const si = vehicle.units === "SI";
  const [w, growth] = [shapes.angular_frequency[mode], shapes.growth_rate[mode]];
  const frequency = si ? `${short(w / 2 / Math.PI)} Hz` : `ω = ${short(w)}`;
  byId("motion").textContent = growth > 1e-9 * Math.max(...shapes.angular_frequency)
    ? `mode ${mode + 1}, ${w ? `${frequency}, flutters: ` : "diverges: "}grows as exp(${short(growth, 4)} t)` : `mode ${mode + 1}, ${frequency}`;
  const thrust = thrustNow();
  if (document.activeElement !== byId("thrust")) byId("thrust").value = short(thrust, 6);
  byId("thrust-unit").textContent = si ? "N" : "";
  if (document.activeElement !== byId("thrust-slider")) byId("thrust-slider").value = Math.round((1000 * thrust) / curve.thrust.at(-1));
  byId("at-nominal").disabled = !vehicle.nominal_thrust;
}

function locus() {
  if (state.now.over === "gain" && model?.vehicle.control) {
    loci.ask({ ...question(), over: "gain", at: Array.from({ length: 41 }, (_, n) => n / 20), thrust: thrustNow() });
  } else charts.thrustLocus(solved, thrustNow());
}

// The response and the map follow when the hand rests.
function slower() {
  clearTimeout(waiting);
  waiting = setTimeout(() => {
    if (!model) return; // its answer comes back to here
    if (!solved) return slower();
    if (model.vehicle.sensors.length) {
      motions.ask({ ...question(), formulation: "objective", duration: duration(), thrust: thrustNow(), mode: state.now.start, amplitude: 0.01 * (model.vehicle.units === "SI" ? model.vehicle.length : 1) });
    } else {
      byId("growth").textContent = "";
      byId("response-error").textContent = "A response is read at sensors, and the vehicle has none. Add one under Edit text.";
      charts.empty("response", "no sensor");
      charts.empty("phase", "no sensor");
    }
    furtherShown();
    const axes = mapAxes();
    if (axes.length === 2) {
      const values = Object.fromEntries(Object.entries(state.now.values).filter(([path]) => !axes.some((axis) => axis.path === path)));
      map.now = axes.map(({ value }) => value);
      map.mark(map.now.map((value) => (value === "inf" ? null : value)));
      map.show({ ...question(), values }, axes, model.vehicle.units, solutions.took > SLOW);
    } else charts.empty("map", "a map needs two quantities");
  }, Math.min(Math.max(4 * solutions.took, 180), 2000));
}

// One of the charts that the vehicle has what they need for.
function furtherShown() {
  const has = { flight: /^\[timeline/m.test(model.model), loop: model.vehicle.control, pulsation: true };
  const list = byId("further-kind");
  for (const [kind, there] of Object.entries(has)) list.querySelector(`[value="${kind}"]`).disabled = !there;
  const kind = has[state.now.further] ? state.now.further : "";
  list.value = kind;
  byId("further").hidden = !kind;
  if (kind) further.show(kind, question(), solved, thrustNow());
  else further.stop();
}

function duration() {
  const given = state.now.duration;
  const period = solved.vehicle.nondimensional.time_scale;
  const value = given ?? Number((1.5 * period).toPrecision(2));
  if (document.activeElement !== byId("duration")) byId("duration").value = short(value);
  return value;
}

function mapAxes() {
  const { quantities } = model;
  const there = (path) => quantities.find((quantity) => quantity.path === path);
  const chosen = (state.now.axes ?? []).map(there);
  const soft = Math.max(0, model.vehicle.joints.findIndex((joint) => joint.rotational_stiffness !== "rigid" || joint.shear_stiffness !== "rigid"));
  const preferred = [`joint[${soft}].rotational_stiffness`, `joint[${soft}].shear_stiffness`, "thrust.tangency", "stage[0].bending_stiffness", "stage[0].length"].map(there).filter(Boolean);
  const [x = preferred[0], y = preferred.find((quantity) => quantity !== (chosen[0] ?? preferred[0]))] = chosen;
  return [x, y].filter(Boolean);
}

function axesOffered() {
  const axes = mapAxes();
  for (const [n, id] of ["map-x", "map-y"].entries()) {
    const list = byId(id);
    const paths = model.quantities.filter(({ path, entry }) => path !== "thrust.nominal" && !entry).map(({ path }) => path);
    if (list.dataset.paths !== paths.join()) {
      list.dataset.paths = paths.join();
      list.replaceChildren(...paths.map((path) => element("option", { value: path }, named(path))));
    }
    list.value = axes[n]?.path ?? "";
  }
}

function sensorsOffered() {
  const list = byId("sensor");
  const names = model.vehicle.sensors.map(({ name }) => name);
  if (list.dataset.names !== names.join()) {
    list.dataset.names = names.join();
    list.replaceChildren(...names.map((name) => element("option", {}, name)));
  }
  for (const label of document.querySelectorAll("#response-panel .bar label")) label.hidden = !names.length;
  if (names.includes(state.now.sensor)) list.value = state.now.sensor;
}

// A joint was dragged to a station; null when it was let go.
function placed(joint) {
  if (!joint) return state.keep();
  const { number, low, high, station } = joint;
  const digits = (value) => Number(value.toPrecision(6));
  const place = number === 0 ? { "stage.split": digits(station / solved.vehicle.length) } : { [`stage[${number}].length`]: digits(station - low), [`stage[${number + 1}].length`]: digits(high - digits(station)) };
  state.set({ values: { ...state.now.values, ...place } });
}

function toast(text) {
  byId("toast").textContent = text;
  setTimeout(() => (byId("toast").textContent = ""), 2500);
}

async function opened(file) {
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    let text = "";
    for (let n = 0; n < bytes.length; n += 32768) text += String.fromCharCode(...bytes.subarray(n, n + 32768));
    const answer = await ask("open", { name: file.name, content: btoa(text) });
    state.open(answer.model);
    const notes = [...answer.notes, ...answer.ignored];
    toast(notes.length ? `${file.name}: ${notes.join("; ")}` : `${file.name} is open`);
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    problems(error.problems.map(({ path, message }) => ({ path: `${file.name}${path ? `, ${path}` : ""}`, message })));
  }
}

function theme(name) {
  document.documentElement.dataset.theme = name;
  byId("theme").textContent = name === "dark" ? "Light" : "Dark";
}

function redraw() {
  if (!solved) return;
  charts.curve(solved, thrustNow());
  locus();
  map.draw();
  further.key = null;
  slower();
}

function wire() {
  const on = (id, event, action) => byId(id).addEventListener(event, action);
  on("example", "change", async ({ target }) => {
    if (target.value) state.open((await read(`examples/${target.value}`)).model);
    target.value = "";
  });
  on("open", "click", () => byId("file").click());
  on("file", "change", ({ target }) => { if (target.files[0]) opened(target.files[0]); target.value = ""; });
  on("save", "click", async () => charts.saveText("vehicle.toml", (await ask("model", question())).model, "application/toml"));
  on("undo", "click", () => state.undo());
  on("redo", "click", () => state.redo());
  on("reset", "click", () => state.reset());
  on("share", "click", async () => { await navigator.clipboard.writeText(location.href); toast("The link is copied"); });
  on("theme", "click", () => {
    theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    localStorage.setItem("beal-theme", document.documentElement.dataset.theme);
    redraw();
  });
  on("edit", "click", async () => {
    byId("text-errors").replaceChildren();
    try {
      byId("text").value = (await ask("model", question())).model;
    } catch {
      byId("text").value = state.now.model;
    }
    byId("text-dialog").showModal();
  });
  on("text-use", "click", async (event) => {
    event.preventDefault();
    try {
      await ask("model", { model: byId("text").value });
      byId("text-dialog").close();
      state.open(byId("text").value);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      byId("text-errors").replaceChildren(...error.problems.map(({ path, message }) => element("li", {}, path ? `${path}: ${message}` : message)));
    }
  });
  on("code", "click", async () => {
    const answer = await ask("export", { ...question(), ...(solved ? { to: solved.curve.thrust.at(-1) } : {}) });
    byId("code-python").value = answer.python;
    byId("code-command").value = answer.command;
    byId("code-dialog").showModal();
  });
  for (const button of document.querySelectorAll("[data-copy]")) button.addEventListener("click", async () => { await navigator.clipboard.writeText(byId(button.dataset.copy).value); toast("Copied"); });
  on("formulation", "change", ({ target }) => { state.set({ formulation: target.value }); state.keep(); });
  on("shown", "change", ({ target }) => { state.set({ mode: Number(target.value) }); state.keep(); });
  const thrust = (value) => state.set({ thrust: value });
  on("thrust", "change", ({ target }) => { const value = parsed(target.value); if (value !== null && value >= 0) { thrust(value); state.keep(); } else if (solved) target.value = short(thrustNow(), 6); });
  on("thrust-slider", "input", ({ target }) => solved && thrust(Number(((target.valueAsNumber / 1000) * solved.curve.thrust.at(-1)).toPrecision(5))));
  on("thrust-slider", "change", () => { state.keep(); slower(); });
  on("at-nominal", "click", () => { thrust(null); state.keep(); });
  on("at-critical", "click", () => {
    const first = solved?.critical.elastic ?? solved?.critical;
    if (first?.critical_thrust) { state.set({ thrust: Number((1.005 * first.critical_thrust).toPrecision(6)), mode: 0 }); state.keep(); } else toast("There is none up to the thrust searched to");
  });
  on("play", "click", ({ target }) => { drawing.play(!drawing.running); target.textContent = drawing.running ? "Pause" : "Play"; target.setAttribute("aria-pressed", String(drawing.running)); });
  on("over", "change", ({ target }) => { state.set({ over: target.value }); state.keep(); });
  for (const id of ["map-x", "map-y"]) on(id, "change", () => { state.set({ axes: [byId("map-x").value, byId("map-y").value] }); state.keep(); slower(); });
  on("further-kind", "change", ({ target }) => {
    state.set({ further: target.value });
    state.keep();
    byId("further").hidden = !target.value;
    byId("further-panel").scrollIntoView({ block: "nearest" });
  });
  on("sensor", "change", ({ target }) => { state.set({ sensor: target.value }); state.keep(); });
  on("start", "change", ({ target }) => { state.set({ start: Number(target.value) }); state.keep(); });
  on("duration", "change", ({ target }) => { const value = parsed(target.value); if (value > 0) { state.set({ duration: value }); state.keep(); } else if (solved) duration(); });
  document.addEventListener("keydown", (event) => {
    const editing = event.target.matches("textarea, input:not([type=range]):not([type=checkbox])");
    if (!(event.ctrlKey || event.metaKey) || editing || event.key.toLowerCase() !== "z") return;
    event.preventDefault();
    if (event.shiftKey) state.redo(); else state.undo();
  });
  document.addEventListener("dragover", (event) => { event.preventDefault(); byId("drop").hidden = false; });
  document.addEventListener("dragleave", (event) => { if (!event.relatedTarget) byId("drop").hidden = true; });
  document.addEventListener("drop", (event) => { event.preventDefault(); byId("drop").hidden = true; if (event.dataTransfer.files[0]) opened(event.dataTransfer.files[0]); });
  addEventListener("hashchange", () => state.fromAddress());
}

async function begin() {
  theme(localStorage.getItem("beal-theme") ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light"));
  const starts = ["at rest, under its forces", ...[1, 2, 3, 4].map((mode) => `mode ${mode}`)];
  byId("start").replaceChildren(...starts.map((name, n) => element("option", { value: n }, name)));
  if (!drawing.running) { byId("play").textContent = "Play"; byId("play").setAttribute("aria-pressed", "false"); }
  charts.saving();
  charts.fitted();
  wire();
  const { model: first, examples } = await read("start");
  for (const name of examples) byId("example").append(element("option", { value: name }, name.replaceAll("_", " ")));
  if (!(await state.fromAddress())) state.open(first);
}

begin();
