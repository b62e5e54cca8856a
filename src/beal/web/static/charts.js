// The charts, drawn by plotly in the colours of the page.

import { element } from "./controls.js";
import { short } from "./numbers.js";

// Okabe & Ito (2008), Color Universal Design
const LIGHT = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];
const DARK = ["#56B4E9", "#E69F00", "#2FC29B", "#CC79A7", "#F0E442", "#D55E00"];
const CONFIG = { displayModeBar: false };
const Plotly = window.Plotly;

export const colours = () => (document.documentElement.dataset.theme === "dark" ? DARK : LIGHT);
export const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

export function axis(title, more = {}) {
  return { title: { text: title, standoff: 6, font: { size: 12 } }, gridcolor: ink("line"), zerolinecolor: ink("line"), linecolor: ink("soft"), ticks: "outside", tickcolor: ink("soft"), ticklen: 3, nticks: 5, tickangle: 0, exponentformat: "power", ...(more.type === "log" ? { tickfont: { size: 9 } } : {}), ...more };
}

// A long title in two lines, for an axis that stands.
export function folded(title) {
  const words = title.split(" ");
  const half = words.findIndex((_, n) => words.slice(0, n + 1).join(" ").length >= title.length / 2);
  return title.length < 16 || half < 0 ? title : `${words.slice(0, half).join(" ")}<br>${words.slice(half).join(" ")}`;
}

export function layout(x, y, more = {}) {
  return {
    margin: { l: 56, r: 12, t: 8, b: 40 }, font: { family: "system-ui, DejaVu Sans, sans-serif", size: 11, color: ink("ink") },
    paper_bgcolor: ink("paper"), plot_bgcolor: ink("paper"), xaxis: x, yaxis: y, showlegend: false, hovermode: "closest",
    hoverlabel: { bgcolor: ink("tint"), bordercolor: ink("line"), font: { color: ink("ink") } }, ...more,
  };
}

export const drawn = new Map(); // name of a chart to the columns behind it

export async function draw(name, traces, frame, columns, told) {
  drawn.set(name, columns);
  const place = document.getElementById(name);
  place.setAttribute("aria-label", `${told ?? ""} Its numbers are under save, CSV.`.trim());
  await Plotly.react(place, traces, frame, CONFIG);
}

export function empty(name, message) {
  const none = { visible: false };
  const note = { text: message.replace(/(.{44}\S*)\s/g, "$1<br>"), showarrow: false, font: { color: ink("soft"), size: 12 }, xref: "paper", yref: "paper", x: 0.5, y: 0.5 };
  return draw(name, [], layout(none, none, { annotations: [note] }), {}, message);
}

export function fitted() {
  const resized = new ResizeObserver((places) => {
    for (const { target } of places) if (target.data && !target.hidden) Plotly.Plots.resize(target);
  });
  for (const place of document.querySelectorAll(".plot")) resized.observe(place);
}

export function saving() {
  for (const list of document.querySelectorAll(".export")) {
    const name = list.dataset.chart;
    list.append(...["PNG", "SVG", "CSV"].map((kind) => element("option", {}, kind)));
    list.addEventListener("change", () => {
      const kind = list.value;
      list.value = "";
      if (kind === "CSV") saveTable(name);
      else savePicture(name, kind.toLowerCase());
    });
  }
}

function savePicture(name, format) {
  return Plotly.downloadImage(document.getElementById(name), { format, filename: `beal-${name}`, width: 900, height: 560, scale: format === "png" ? 2 : 1 });
}

function saveTable(name) {
  const columns = drawn.get(name) ?? {};
  const rows = Math.max(0, ...Object.values(columns).map((column) => column.length));
  const lines = [Object.keys(columns).join(",")];
  for (let n = 0; n < rows; n += 1) lines.push(Object.values(columns).map((column) => column[n] ?? "").join(","));
  saveText(`beal-${name}.csv`, `${lines.join("\n")}\n`, "text/csv");
}

export function saveText(name, text, kind) {
  const link = element("a", { href: URL.createObjectURL(new Blob([text], { type: kind })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Thrust on an axis: its factor and its title.
export function thrustAxis(largest, units) {
  if (units !== "SI") return [1, "thrust P"];
  const [factor, unit] = largest >= 1e6 ? [1e6, "MN"] : largest >= 1e3 ? [1e3, "kN"] : [1, "N"];
  return [factor, `thrust P (${unit})`];
}

const first = (critical) => critical.elastic ?? critical;

// The point at which modes meet lies on both curves: a sweep alone would leave a gap there.
function met(curve, mode, critical) {
  const { critical_thrust: P, angular_frequency: w, modes } = first(critical);
  const x = [...curve.thrust];
  const y = curve.angular_frequency.map((row) => row[mode]);
  const growth = curve.growth_rate.map((row) => row[mode]);
  const n = x.findIndex((thrust) => thrust >= P);
  if (P && modes?.includes(mode + 1) && n > 0 && Math.abs(y[n] - w) < 0.5 * Math.abs(w || y[0])) {
    x.splice(n, 0, P);
    y.splice(n, 0, w);
    growth.splice(n, 0, 0);
  }
  return { x, y, growth };
}

export function curve({ curve: found, critical, vehicle }, thrust) {
  const hertz = found.units === "SI" ? 2 * Math.PI : 1;
  const last = found.thrust.at(-1);
  const [factor, title] = thrustAxis(last, found.units);
  const count = found.angular_frequency[0].length;
  const traces = [];
  for (let mode = 0; mode < count; mode += 1) {
    const { x, y } = met(found, mode, critical);
    traces.push({
      type: "scatter", mode: "lines", name: `mode ${mode + 1}`, x: x.map((P) => P / factor), y: y.map((w) => w / hertz),
      line: { color: colours()[mode % 6], width: 2 }, hovertemplate: `mode ${mode + 1}<br>P %{x:.5g}<br>%{y:.5g}<extra></extra>`,
    });
  }
  const { critical_thrust: P, angular_frequency: w, kind, modes } = first(critical);
  const shapes = [], annotations = [];
  if (P > 0) {
    traces.push({
      type: "scatter", mode: "markers", x: [P / factor], y: [w / hertz], name: kind, cliponaxis: false,
      marker: { symbol: kind === "flutter" ? "diamond" : "square", size: 10, color: ink("paper"), line: { color: ink("alarm"), width: 2.5 } },
      hovertemplate: `${kind} at ${short(P, 7)}<extra></extra>`,
    });
    const who = modes[0] === modes[1] ? `mode ${modes[0]}` : `modes ${modes.join(" and ")}`;
    annotations.push({ x: P / factor, y: w / hertz, text: `${kind}<br>${who}`, ax: 12, ay: -36, xanchor: "left", align: "left", bgcolor: ink("paper"), font: { color: ink("alarm") }, arrowcolor: ink("alarm"), arrowwidth: 1, arrowhead: 0 });
    shapes.push({ type: "rect", x0: P / factor, x1: last / factor, y0: 0, y1: 1, yref: "paper", fillcolor: ink("alarm"), opacity: 0.09, line: { width: 0 }, layer: "below" });
  }
  if (vehicle.nominal_thrust && vehicle.nominal_thrust < last) {
    shapes.push(upright(vehicle.nominal_thrust / factor, "dot", ink("soft")));
    annotations.push({ x: vehicle.nominal_thrust / factor, y: 1, yref: "paper", text: "nominal", showarrow: false, xanchor: vehicle.nominal_thrust > 0.15 * last ? "right" : "left", xshift: vehicle.nominal_thrust > 0.15 * last ? 0 : 10, yanchor: "top", font: { color: ink("soft") } });
  }
  shapes.push(upright(thrust / factor, "solid", ink("accent")));
  for (let mode = 0; mode < count; mode += 1) {
    const y = found.angular_frequency[0][mode] / hertz;
    annotations.push({ x: 0, y, text: `${mode + 1}`, showarrow: false, xanchor: "left", yanchor: "bottom", font: { color: colours()[mode % 6] } });
  }
  const columns = { thrust: found.thrust };
  for (let mode = 0; mode < count; mode += 1) {
    columns[`angular_frequency_${mode + 1}`] = found.angular_frequency.map((row) => row[mode]);
    columns[`growth_rate_${mode + 1}`] = found.growth_rate.map((row) => row[mode]);
  }
  const y = axis(found.units === "SI" ? "frequency (Hz)" : "angular frequency ω", { rangemode: "tozero" });
  const words = `Frequencies of ${count} modes over thrust${P > 0 ? `; ${kind} at ${short(P, 7)}` : kind ? "; stable" : ""}.`;
  return draw("curve", traces, layout(axis(title, { range: [0, last / factor] }), y, { shapes, annotations }), columns, words);
}

export function upright(x, dash, color) {
  return { type: "line", x0: x, x1: x, y0: 0, y1: 1, yref: "paper", line: { width: 1.5, dash, color } };
}

export function thrustLocus({ curve: found, critical }, thrust) {
  const count = found.angular_frequency[0].length;
  const traces = [];
  const columns = { thrust: found.thrust };
  for (let mode = 0; mode < count; mode += 1) {
    const { x: P, y, growth } = met(found, mode, critical);
    const n = P.reduce((best, value, at) => (Math.abs(value - thrust) < Math.abs(P[best] - thrust) ? at : best), 0);
    traces.push(
      { type: "scatter", mode: "lines", x: growth, y, line: { color: colours()[mode % 6], width: 2 }, customdata: P, hovertemplate: `mode ${mode + 1}<br>P %{customdata:.5g}<br>s = %{x:.4g} + %{y:.4g} i<extra></extra>` },
      { type: "scatter", mode: "markers", x: [growth[n]], y: [y[n]], marker: { color: colours()[mode % 6], size: 8, line: { color: ink("paper"), width: 1 } }, hoverinfo: "skip" },
    );
    columns[`real_${mode + 1}`] = found.growth_rate.map((row) => row[mode]);
    columns[`imag_${mode + 1}`] = found.angular_frequency.map((row) => row[mode]);
  }
  return draw("locus", traces, locusLayout(found.units, traces), columns, "Roots over thrust.");
}

export function gainLocus(found, units) {
  const columns = { [found.over]: found.values };
  const traces = found.real[0].map((_, root) => {
    const [x, y] = [found.real.map((row) => row[root]), found.imag.map((row) => row[root])];
    columns[`real_${root + 1}`] = x;
    columns[`imag_${root + 1}`] = y;
    return { type: "scatter", mode: "lines+markers", x, y, line: { color: colours()[root % 6], width: 1.5 }, marker: { size: found.values.map((value) => (value === 1 ? 8 : 3)) }, customdata: found.values, hovertemplate: `${found.over} %{customdata:.4g}<br>s = %{x:.4g} + %{y:.4g} i<extra></extra>` };
  });
  return draw("locus", traces, locusLayout(units, traces), columns, "Roots of the closed loop over the gain.");
}

function locusLayout(units, traces) {
  const unit = units === "SI" ? [" (1/s)", " (rad/s)"] : ["", ""];
  const widest = Math.max(1e-9, ...traces.flatMap(({ x }) => x.map(Math.abs)));
  const highest = Math.max(1e-9, ...traces.flatMap(({ y }) => y));
  const range = Math.max(1.15 * widest, 0.05 * highest);
  const unstable = { type: "rect", x0: 0, x1: range, y0: 0, y1: 1, yref: "paper", fillcolor: ink("alarm"), opacity: 0.09, line: { width: 0 }, layer: "below" };
  const note = { x: range, y: 1, yref: "paper", text: "grows", showarrow: false, xanchor: "right", yanchor: "top", font: { color: ink("alarm") } };
  return layout(axis(`growth rate Re s${unit[0]}`, { range: [-range, range] }), axis(`Im s${unit[1]}`, { rangemode: "tozero" }), { shapes: [unstable], annotations: [note] });
}

export function motion(found, sensor) {
  const read = found.sensors[sensor];
  const si = found.units === "SI";
  const line = { color: colours()[0], width: 1.3 };
  const y = axis(si ? "deflection (m)" : "deflection y");
  const columns = { time: found.time, displacement: read.displacement, rate: read.rate };
  draw("response", [{ type: "scatter", mode: "lines", x: found.time, y: read.displacement, line, hovertemplate: "t %{x:.4g}<br>y %{y:.4g}<extra></extra>" }],
    layout(axis(si ? "time (s)" : "time t"), y), columns, `Deflection at ${sensor} over time.`);
  const ends = { type: "scatter", mode: "markers", x: [read.displacement[0]], y: [read.rate[0]], marker: { color: ink("ink"), size: 6, symbol: "circle-open" }, hovertemplate: "start<extra></extra>" };
  return draw("phase", [{ type: "scatter", mode: "lines", x: read.displacement, y: read.rate, line, hoverinfo: "skip" }, ends],
    layout(axis(si ? "deflection (m)" : "deflection y", { tickfont: { size: 9 } }), axis(si ? "rate (m/s)" : "rate dy/dt")), columns, `Rate over deflection at ${sensor}.`);
}
