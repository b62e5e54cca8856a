// The stability map over two quantities: from a coarse grid to a fine one, in questions of a bounded time.

import { Refused, ask } from "./api.js";
import { axis, draw, empty, folded, ink, layout, thrustAxis } from "./charts.js";
import { named } from "./numbers.js";

const LEVELS = [5, 9, 17, 33, 65]; // points along each axis
const PATIENCE = 250; // ms for one question
const PAINTED = 700; // ms from one look at a level that is not complete to the next
const UNSOLVED = { P: null, kind: "", modes: ["", ""], status: "not solved yet" };

export class StabilityMap {
  #stop = null;

  constructor(progress, stopButton, chosen) {
    Object.assign(this, { progress, stopButton, chosen });
    stopButton.addEventListener("click", () => {
      this.ended = this.key;
      this.stop();
    });
    this.place = document.getElementById("map");
  }

  // Until `show` is called again, which goes on where it was; for good where the user wants it.
  stop() {
    this.#stop?.abort();
    this.#stop = null;
    this.stopButton.hidden = this.progress.hidden = true;
  }

  // `axes` are two quantities; everything else is in the question. A slow vehicle is asked about point by point.
  async show(question, axes, units, slow) {
    const key = JSON.stringify([question, axes.map(({ path, from, to }) => [path, from, to])]);
    if (key === this.key && (this.#stop || key === this.ended)) return;
    this.stop();
    const stop = new AbortController();
    if (key !== this.key) Object.assign(this, { key, axes, units, found: new Map(), level: 0, ended: null });
    this.#stop = stop;
    this.stopButton.hidden = this.progress.hidden = false;
    let many = slow ? 1 : this.many ?? 2;
    try {
      for (const level of LEVELS.keys()) {
        const waiting = missing(level, this.found);
        while (waiting.length) {
          const part = waiting.splice(0, many);
          const points = part.map(([i, j]) => [at(axes[0], i), at(axes[1], j)]);
          const began = performance.now();
          const answer = await ask("map", { ...question, axes: axes.map(({ path }) => path), points }, stop.signal);
          const took = performance.now() - began;
          many = Math.round(Math.min(Math.max((part.length * PATIENCE) / Math.max(took, 10), 1), many * 3, 600));
          this.many = many;
          part.forEach(([i, j], n) => this.found.set(`${i},${j}`, { P: answer.critical_thrust[n], kind: answer.kinds[answer.kind[n]], modes: [answer.mode_low[n], answer.mode_high[n]], status: answer.statuses[answer.status[n]] }));
          if (performance.now() > (this.next ?? 0) && level === this.level) await this.draw();
          this.progress.value = this.found.size / LEVELS.at(-1) ** 2;
        }
        if (level < this.level) continue;
        this.level = level;
        await this.draw();
      }
    } catch (error) {
      if (error.name === "AbortError") return;
      if (!(error instanceof Refused)) throw error;
      this.key = null;
      await empty("map", error.message);
    }
    if (this.#stop === stop) {
      this.ended = key;
      this.stop();
    }
  }

  async draw() {
    if (!this.found?.size) return;
    const side = LEVELS[this.level];
    const step = (LEVELS.at(-1) - 1) / (side - 1);
    const [X, Y] = this.axes;
    const index = Array.from({ length: side }, (_, n) => n * step);
    const cell = (n, m) => this.found.get(`${index[n]},${index[m]}`) ?? UNSOLVED;
    this.next = performance.now() + PAINTED;
    const solved = [...this.found.values()].map(({ P }) => P).filter((P) => P !== null);
    const [factor, title] = thrustAxis(Math.max(...solved, 0), this.units);
    const z = index.map((_, m) => index.map((_, n) => (cell(n, m).P === null ? null : cell(n, m).P / factor)));
    const text = index.map((_, m) => index.map((_, n) => told(cell(n, m))));
    const [x, y] = [index.map((i) => at(X, i)), index.map((j) => at(Y, j))];
    const heat = {
      type: "heatmap", x, y, z, text, colorscale: "Cividis", hovertemplate: "%{text}<br>P %{z:.5g}<br>%{x:.4g}, %{y:.4g}<extra></extra>",
      colorbar: { title: { text: title, side: "right" }, thickness: 10, outlinewidth: 0, tickfont: { size: 10 } }, hoverongaps: true,
    };
    const frame = layout(mapAxis(X), mapAxis(Y, folded), { annotations: regions(index, cell, x, y, this.axes, this.now ?? [], this.place), margin: { l: 64, r: 4, t: 8, b: 40 } });
    const columns = { [X.path]: [], [Y.path]: [], critical_thrust: [], kind: [], mode_low: [], mode_high: [], status: [] };
    index.forEach((_, m) => index.forEach((_, n) => {
      const { P, kind, modes, status } = cell(n, m);
      [x[n], y[m], P ?? "", kind, ...modes, status].forEach((value, k) => Object.values(columns)[k].push(value));
    }));
    await draw("map", [heat, borders(index, cell, x, y, this.axes), this.#here()], frame, columns, `Critical thrust over ${named(X.path)} and ${named(Y.path)}.`);
    if (!this.listening) {
      this.listening = true;
      this.place.on("plotly_click", ({ points: [point] }) => this.chosen(this.axes, [point.x, point.y]));
    }
  }

  // Where the vehicle is now.
  #here() {
    const [x, y] = this.now ?? [null, null];
    return { type: "scatter", mode: "markers", x: [x], y: [y], cliponaxis: false, marker: { symbol: "circle", size: 11, color: ink("paper"), line: { color: ink("ink"), width: 2.5 } }, hovertemplate: "the vehicle<extra></extra>" };
  }

  mark(now) {
    this.now = now;
    if (this.place.data?.length === 3) window.Plotly.restyle(this.place, { x: [[now[0]]], y: [[now[1]]] }, [2]);
  }
}

function at({ from, to, scale }, index) {
  const share = index / (LEVELS.at(-1) - 1);
  return scale === "log" ? from * (to / from) ** share : from + share * (to - from);
}

function missing(level, found) {
  const step = (LEVELS.at(-1) - 1) / (LEVELS[level] - 1);
  const places = [];
  for (let j = 0; j < LEVELS.at(-1); j += step) for (let i = 0; i < LEVELS.at(-1); i += step) if (!found.has(`${i},${j}`)) places.push([i, j]);
  return places;
}

function mapAxis({ path, scale, from, to, unit }, shaped = (title) => title) {
  const range = scale === "log" ? [Math.log10(from), Math.log10(to)] : [from, to];
  return axis(shaped(`${named(path)}${unit ? ` (${unit.replaceAll("*", " ")})` : ""}`), { type: scale, range, dtick: scale === "log" ? 1 : undefined, showgrid: false });
}

const told = ({ kind, modes, status }) => (status !== "solved" ? status.replaceAll("_", " ") : kind === "stable" ? "stable" : modes[0] === modes[1] ? `${kind}, mode ${modes[0]}` : `${kind}, modes ${modes[0]} and ${modes[1]}`);

// Lines between neighbouring points of another kind or other modes.
function borders(index, cell, x, y, [X, Y]) {
  const between = (values, n, { scale }) => (scale === "log" ? Math.sqrt(values[n] * values[n + 1]) : (values[n] + values[n + 1]) / 2);
  const edges = (values, spacing) => [spacing.from, ...values.slice(0, -1).map((_, n) => between(values, n, spacing)), spacing.to];
  const [u, v] = [edges(x, X), edges(y, Y)];
  const line = { x: [], y: [] };
  const last = index.length - 1;
  for (let m = 0; m <= last; m += 1) for (let n = 0; n <= last; n += 1) {
    if (n < last && told(cell(n, m)) !== told(cell(n + 1, m))) { line.x.push(u[n + 1], u[n + 1], null); line.y.push(v[m], v[m + 1], null); }
    if (m < last && told(cell(n, m)) !== told(cell(n, m + 1))) { line.x.push(u[n], u[n + 1], null); line.y.push(v[m + 1], v[m + 1], null); }
  }
  return { type: "scatter", mode: "lines", ...line, line: { color: "#ffffff", width: 1.6 }, hoverinfo: "skip" };
}

// The name of each kind of instability, at the point of its region that is farthest from its border.
function regions(index, cell, x, y, axes, now, { clientWidth, clientHeight }) {
  const last = index.length - 1;
  const best = new Map();
  for (let m = 0; m <= last; m += 1) for (let n = 0; n <= last; n += 1) {
    const name = told(cell(n, m));
    let reach = 0;
    const same = (a, b) => a >= 0 && b >= 0 && a <= last && b <= last && told(cell(a, b)) === name;
    while (reach < last && same(n - reach - 1, m) && same(n + reach + 1, m) && same(n, m - reach - 1) && same(n, m + reach + 1)) reach += 1;
    if (reach > (best.get(name)?.reach ?? 0)) best.set(name, { reach, n, m });
  }
  const place = (values, n, { scale }) => (scale === "log" ? Math.log10(values[n]) : values[n]);
  const share = (value, { from, to, scale }) => (scale === "log" ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from));
  const hides = (n, m) => Math.abs(share(x[n], axes[0]) - share(now[0], axes[0])) < 0.25 && Math.abs(share(y[m], axes[1]) - share(now[1], axes[1])) < 0.1;
  const near = (a, b) => Math.abs(a.n - b.n) * clientWidth < 140 * last && Math.abs(a.m - b.m) * (clientHeight - 48) < 19 * last;
  const [, names] = [...best].filter(([, { reach }]) => reach >= 0.06 * last).sort((a, b) => b[1].reach - a[1].reach)
    .reduce(([taken, kept], [text, at]) => (taken.some((other) => near(at, other)) ? [taken, kept] : [[...taken, at], [...kept, [text, at]]]), [[], []]);
  return names.map(([text, { n, m }]) => ({
    x: place(x, n, axes[0]), y: place(y, m, axes[1]), text, yshift: hides(n, m) ? -24 : 0, showarrow: false, font: { color: "#ffffff", size: 11 }, bgcolor: "rgba(0,0,0,.55)", borderpad: 2,
  }));
}
