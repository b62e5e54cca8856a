// Charts that only some vehicles have: margins over a flight, a pulsating thrust, the control loop.

import { Refused, ask } from "./api.js";
import { axis, colours, draw, empty, ink, layout, thrustAxis, upright } from "./charts.js";
import { short } from "./numbers.js";

const SOME = 1; // times of a flight in one question
const GRID = [61, 41]; // frequencies and amplitudes of a chart; so many of the first in one question:
const ROWS = 2;
const CROWDED = 0.025; // share of the width below which the name of a resonance would cover the one before
const FAR = 20; // ratio of thrusts from which their axis is logarithmic

export class Further {
  #stop = null;

  constructor(progress, stopButton) {
    Object.assign(this, { progress, stopButton });
    stopButton.addEventListener("click", () => this.stop());
  }

  stop() {
    this.#stop?.abort();
    this.#stop = null;
    this.stopButton.hidden = this.progress.hidden = true;
  }

  async show(kind, question, solved, thrust) {
    const key = JSON.stringify([kind, question, thrust]);
    if (key === this.key) return;
    this.stop();
    this.key = key;
    const stop = new AbortController();
    this.#stop = stop;
    this.stopButton.hidden = this.progress.hidden = false;
    this.progress.value = 0;
    say("");
    try {
      for await (const share of DRAWN[kind](question, solved, thrust, stop.signal)) this.progress.value = share;
    } catch (error) {
      if (error.name === "AbortError") return;
      if (!(error instanceof Refused)) throw error;
      await empty("further", error.message);
    }
    if (this.#stop === stop) this.stop();
  }
}

const DRAWN = { flight, pulsation, loop };

// What a chart says, in words beside its name.
function say(words, alarming = false) {
  const note = document.getElementById("further-note");
  note.textContent = words;
  note.classList.toggle("alarm", alarming);
}

async function* flight(question, solved, thrust, signal) {
  const columns = { time: [], thrust: [], critical_thrust: [], kind: [], searched_to: [], margin: [], margin_is_lower_bound: [], stages: [] };
  for (let first = 0, times = 1; first < times; first += SOME) {
    const answer = await ask("flight", { ...question, formulation: "objective", first, count: SOME }, signal);
    times = answer.times;
    for (const [name, column] of Object.entries(columns)) column.push(...answer[name]);
    await flightDrawn(columns, answer.units);
    yield columns.time.length / times;
  }
}

// Above the thrust what the vehicle bears: where it is not known, at least the thrust that was searched to.
function flightDrawn(columns, units) {
  const { time, thrust, critical_thrust: critical, kind, searched_to: searched, margin, margin_is_lower_bound: bound, stages } = columns;
  const borne = time.map((_, n) => (bound[n] ? searched[n] : critical[n]));
  const largest = Math.max(...thrust, ...borne);
  const positive = thrust.filter((value) => value > 0);
  const [factor, title] = thrustAxis(largest, units);
  const scaled = (values, chosen) => values.map((value, n) => (chosen(n) && value > 0 ? value / factor : null));
  const bears = (name, chosen, look) => ({ type: "scatter", mode: "lines+markers", name, x: time, y: scaled(borne, chosen), marker: { size: 5, ...look.marker }, line: { color: colours()[0], width: 2, ...look.line }, customdata: margin.map((share) => (share === null ? "" : short(100 * share, 4))), hovertemplate: `${name} %{y:.5g}<br>t %{x:.5g}, margin %{customdata} %<extra></extra>` });
  const traces = [
    bears("flutter", (n) => kind[n] === "flutter", {}),
    bears("divergence", (n) => kind[n] === "divergence", { line: { dash: "dash" } }),
    bears("stable up to", (n) => bound[n], { line: { width: 0 }, marker: { symbol: "triangle-up-open", size: 9 } }),
    { type: "scatter", mode: "lines", name: "thrust", x: time, y: scaled(thrust, () => true), line: { color: ink("ink"), width: 2 }, hovertemplate: "thrust %{y:.5g}<br>t %{x:.5g}<extra></extra>" },
  ].filter(({ y }) => y.some((value) => value !== null));
  const separations = time.map((_, n) => n).filter((n) => n && stages[n] !== stages[n - 1]);
  const shapes = separations.map((n) => upright((time[n - 1] + time[n]) / 2, "dot", ink("soft")));
  const annotations = separations.map((n) => ({ x: (time[n - 1] + time[n]) / 2, y: 1, yref: "paper", xanchor: "left", yanchor: "top", text: `stages ${stages[n]} fly on`, showarrow: false, font: { color: ink("soft") } }));
  const known = margin.filter((share) => share !== null);
  const least = Math.min(...known);
  const told = !known.length ? "no thrust" : least < 0 ? `unstable: margin down to ${short(100 * least, 4)} %` : `margin at least ${short(100 * least, 4)} %`;
  say(told, least < 0);
  const y = axis(title.replace(" P", ""), largest > FAR * Math.min(...positive) ? { type: "log", dtick: 1 } : { rangemode: "tozero" });
  const legend = { orientation: "h", x: 0, y: 1, xanchor: "left", yanchor: "bottom", bgcolor: "rgba(0,0,0,0)" };
  const frame = layout(axis(units === "SI" ? "time (s)" : "time t", { nticks: 9 }), y, { shapes, annotations, legend, showlegend: true, margin: { l: 56, r: 12, t: 28, b: 40 } });
  return draw("further", traces, frame, columns, `Thrust and what the vehicle bears over time, ${told}.`);
}

async function* pulsation(question, solved, thrust, signal) {
  const { curve } = solved;
  const highest = 2.2 * curve.angular_frequency[0][Math.min(1, curve.angular_frequency[0].length - 1)];
  const largest = 0.5 * (thrust || curve.thrust.at(-1));
  const frequencies = Array.from({ length: GRID[0] }, (_, n) => (highest * (n + 1)) / GRID[0]);
  const amplitudes = Array.from({ length: GRID[1] }, (_, n) => (largest * n) / (GRID[1] - 1));
  const known = { ...question, formulation: "objective", thrust, amplitudes };
  const rows = frequencies.map(() => null);
  const waiting = halved(GRID[0]); // both ends first: all resonances lie between
  let resonances = null;
  while (waiting.length) {
    const some = waiting.splice(0, ROWS).sort((a, b) => a - b);
    const answer = await ask("pulsation", { ...known, angular_frequencies: some.map((n) => frequencies[n]) }, signal);
    resonances ??= answer.resonances;
    some.forEach((row, n) => (rows[row] = answer.growth_rate[n].map((rate, m) => ({ rate, stable: answer.stable[n][m] }))));
    await pulsationDrawn({ frequencies, amplitudes, rows, resonances, units: curve.units });
    yield 1 - waiting.length / GRID[0];
  }
}

// Numbers below a count, from far apart to side by side.
function halved(count) {
  const order = new Set([0, count - 1]);
  for (let step = count / 2; step >= 0.5; step /= 2) for (let at = step; at < count; at += step) order.add(Math.floor(at));
  return [...order];
}

function pulsationDrawn({ frequencies, amplitudes, rows, resonances, units }) {
  const si = units === "SI";
  const [factor, title] = thrustAxis(amplitudes.at(-1), units);
  const hertz = si ? 2 * Math.PI : 1;
  const highest = frequencies.at(-1);
  const known = rows.map((_, n) => n).filter((n) => rows[n]);
  const z = amplitudes.map((_, m) => known.map((n) => (rows[n][m].stable ? null : rows[n][m].rate)));
  const heat = { type: "heatmap", x: known.map((n) => frequencies[n] / hertz), y: amplitudes.map((amplitude) => amplitude / factor), z, colorscale: "Cividis", colorbar: { title: { text: si ? "growth (1/s)" : "growth rate", side: "right" }, thickness: 10, outlinewidth: 0 }, hovertemplate: "W %{x:.4g}<br>P1 %{y:.4g}<br>growth %{z:.3g}<extra></extra>" };
  const shapes = [], annotations = [];
  let last = -Infinity;
  for (const { name, angular_frequency: omega } of resonances) {
    shapes.push({ ...upright(omega / hertz, "solid", ink("soft")), y1: name.includes("/") ? 0.06 : 1, line: { width: 0.8, color: ink("soft") } });
    if (omega - last < CROWDED * highest) continue;
    last = omega;
    annotations.push({ x: omega / hertz, y: 1, yref: "paper", yanchor: "bottom", textangle: -90, text: name.replace(/w(\d+)/g, "ω<sub>$1</sub>"), showarrow: false, font: { size: 10, color: ink("soft") } });
  }
  const columns = { angular_frequency: [], amplitude: [], growth_rate: [] };
  for (const n of known) rows[n].forEach(({ rate }, m) => [frequencies[n], amplitudes[m], rate].forEach((value, k) => Object.values(columns)[k].push(value)));
  const x = axis(si ? "frequency of the thrust (Hz)" : "angular frequency Ω of the thrust", { range: [0, highest / hertz], nticks: 9 });
  const frame = layout(x, axis(title.replace("thrust P", "amplitude P1"), { range: [0, amplitudes.at(-1) / factor] }), { shapes, annotations, margin: { l: 56, r: 12, t: 62, b: 40 } });
  return draw("further", [heat], frame, columns, `Where a pulsating thrust makes the motion grow; resonances ${resonances.map(({ name }) => name).join(", ")}.`);
}

async function* loop(question, solved, thrust, signal) {
  const answer = await ask("loop", { ...question, formulation: "objective", thrust }, signal);
  const { angular_frequency: omega, value } = answer.open_loop;
  const [x, y] = [0, 1].map((part) => value.map((pair) => pair[part]));
  const curve = { type: "scatter", mode: "lines", x, y, customdata: omega, line: { color: colours()[0], width: 1.6 }, hovertemplate: "ω %{customdata:.5g}<br>L = %{x:.4g} + %{y:.4g} i<extra></extra>" };
  const point = { type: "scatter", mode: "markers", x: [-1], y: [0], marker: { symbol: "x", size: 9, color: ink("alarm") }, hovertemplate: "critical point -1<extra></extra>" };
  const { gain, phase } = answer.margins;
  const least = (list, name) => list.reduce((best, each) => (best === null || Math.abs(each[name]) < Math.abs(best) ? each[name] : best), null);
  const [decibel, degrees] = [least(gain, "decibel"), least(phase, "degrees")];
  const told = [answer.stable ? "closed loop stable" : "closed loop unstable", decibel === null ? "" : `gain margin ${short(decibel, 3)} dB`, degrees === null ? "" : `phase margin ${short(degrees, 3)}°`].filter(Boolean).join(", ");
  say(told, !answer.stable);
  const frame = layout(axis("Re L", { range: [-3, 3] }), axis("Im L", { range: [-3, 3], scaleanchor: "x" }));
  await draw("further", [curve, point], frame, { angular_frequency: omega, real: x, imag: y }, `Open loop, ${told}.`);
  yield 1;
}
