// Charts that only some vehicles have: margins over a flight, a pulsating thrust, the control loop.

import { Refused, ask } from "./api.js";
import { axis, colours, draw, empty, ink, layout, thrustAxis } from "./charts.js";
import { short } from "./numbers.js";

const SOME = 1; // times of a flight in one question
const GRID = [32, 21]; // frequencies and amplitudes of a chart; so many of the first in one question:
const ROWS = 2;

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

async function* flight(question, solved, thrust, signal) {
  const columns = { time: [], thrust: [], critical_thrust: [], margin: [] };
  for (let first = 0, times = 1; first < times; first += SOME) {
    const answer = await ask("flight", { ...question, formulation: "objective", first, count: SOME }, signal);
    times = answer.times;
    for (const [name, column] of Object.entries(columns)) column.push(...answer[name]);
    const si = answer.units === "SI";
    const percent = columns.margin.map((margin) => (margin === null ? null : 100 * margin));
    const line = { type: "scatter", mode: "lines+markers", x: columns.time, y: percent, line: { color: colours()[0], width: 2 }, hovertemplate: "t %{x:.5g}<br>margin %{y:.4g} %<extra></extra>" };
    const y = axis("margin over the thrust (%)", { rangemode: "tozero" });
    const least = percent.reduce((low, margin) => (margin !== null && margin < low ? margin : low), Infinity);
    await draw("further", [line], layout(axis(si ? "time (s)" : "time t"), y), columns, `Margin over time, at least ${short(least, 4)} %.`);
    yield columns.time.length / times;
  }
}

async function* pulsation(question, solved, thrust, signal) {
  const { curve } = solved;
  const highest = 2.2 * curve.angular_frequency[0][Math.min(1, curve.angular_frequency[0].length - 1)];
  const largest = 0.5 * (thrust || curve.thrust.at(-1));
  const frequencies = Array.from({ length: GRID[0] }, (_, n) => (highest * (n + 1)) / GRID[0]);
  const amplitudes = Array.from({ length: GRID[1] }, (_, n) => (largest * n) / (GRID[1] - 1));
  const si = curve.units === "SI";
  const [factor, title] = thrustAxis(largest, curve.units);
  const hertz = si ? 2 * Math.PI : 1;
  const columns = { angular_frequency: [], amplitude: [], growth_rate: [] };
  const growth = [];
  const known = { ...question, formulation: "objective", thrust, amplitudes };
  for (let first = 0; first < GRID[0]; first += ROWS) {
    const some = frequencies.slice(first, first + ROWS);
    const answer = await ask("pulsation", { ...known, angular_frequencies: some }, signal);
    some.forEach((frequency, n) => {
      growth.push(answer.growth_rate[n].map((rate, m) => (answer.stable[n][m] ? null : rate)));
      for (const [m, amplitude] of amplitudes.entries()) {
        columns.angular_frequency.push(frequency);
        columns.amplitude.push(amplitude);
        columns.growth_rate.push(answer.growth_rate[n][m]);
      }
    });
    const x = frequencies.slice(0, growth.length).map((frequency) => frequency / hertz);
    const z = amplitudes.map((_, m) => growth.map((row) => row[m]));
    const heat = { type: "heatmap", x, y: amplitudes.map((amplitude) => amplitude / factor), z, colorscale: "Cividis", colorbar: { title: { text: si ? "growth (1/s)" : "growth", side: "right" }, thickness: 10, outlinewidth: 0 }, hovertemplate: "W %{x:.4g}<br>P1 %{y:.4g}<br>growth %{z:.3g}<extra></extra>" };
    const frame = layout(axis(si ? "frequency of the thrust (Hz)" : "angular frequency W", { range: [0, highest / hertz] }), axis(title.replace("thrust P", "amplitude P1")));
    await draw("further", [heat], frame, columns, "Where a pulsating thrust makes the motion grow.");
    yield growth.length / GRID[0];
  }
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
  const note = { text: told, xref: "paper", yref: "paper", x: 1, y: 1, xanchor: "right", yanchor: "top", showarrow: false, font: { color: ink(answer.stable ? "good" : "alarm") }, bgcolor: ink("paper") };
  const frame = layout(axis("Re L", { range: [-3, 3] }), axis("Im L", { range: [-3, 3], scaleanchor: "x" }), { annotations: [note] });
  await draw("further", [curve, point], frame, { angular_frequency: omega, real: x, imag: y }, `Open loop, ${told}.`);
  yield 1;
}
