"""The look of a report: a readable column, tables that stay legible, dark where the reader wants it, sensible print."""

CSS = """
:root { color-scheme: light dark; --paper: #fff; --ink: #1b1b1b; --soft: #555; --line: #cfcfcf; --tint: #f5f6f8;
  --accent: #0072b2; --holds: #d9efe7; --part: #fdf0d0; --fails: #f9ddd0; }
@media screen and (prefers-color-scheme: dark) { :root { --paper: #16181b; --ink: #e4e4e2; --soft: #a5a8ac;
  --line: #43474d; --tint: #22262b; --accent: #7cc0ec; --holds: #17443a; --part: #4a3c12; --fails: #5b2a1a; } }
* { box-sizing: border-box; }
body { margin: 0; color: var(--ink); background: var(--paper); font: 17px/1.58 Charter, "Bitstream Charter",
  "Source Serif 4", Cambria, Georgia, "DejaVu Serif", serif; }
main { max-width: 860px; margin: 0 auto; padding: 2.5rem 1.1rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.22; margin: 0 0 .5rem; text-wrap: balance; }
h2 { font-size: 1.32rem; line-height: 1.3; margin: 2.8rem 0 .6rem;
  padding-top: .8rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.06rem; margin: 1.9rem 0 .4rem; }
p { margin: .6rem 0 .9rem; hyphens: auto; }
a { color: var(--accent); text-underline-offset: .15em; }
.byline { color: var(--soft); margin: 0 0 1.6rem; font-size: .93rem; }
.abstract { background: var(--tint); border-left: 4px solid var(--accent); padding: .9rem 1.2rem; margin: 1.4rem 0; }
.abstract p:first-child { margin-top: 0; } .abstract p:last-child { margin-bottom: 0; }
nav { font-size: .93rem; margin: 1.2rem 0; } nav a { margin-right: 1rem; white-space: nowrap; }
.eq { overflow-x: auto; padding: .35rem 0 .35rem 1.6rem; font-size: 1.05rem; white-space: nowrap; }
.wide { overflow-x: auto; margin: 1rem 0 1.3rem; }
table { border-collapse: collapse; font-size: .83rem; line-height: 1.4; width: 100%; font-variant-numeric: tabular-nums;
  font-family: system-ui, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; }
caption { text-align: left; color: var(--soft); padding-bottom: .45rem; font-size: .85rem; }
th { text-align: left; font-weight: 600; border-bottom: 1.5px solid var(--ink); padding: .32rem .55rem;
  vertical-align: bottom; }
td { border-bottom: 1px solid var(--line); padding: .32rem .55rem; vertical-align: top; }
td.n, th.n { text-align: right; white-space: nowrap; }
.v { font-weight: 600; white-space: nowrap; }
.holds { background: var(--holds); } .part { background: var(--part); } .fails { background: var(--fails); }
figure { margin: 1.5rem 0 2rem; break-inside: avoid; }
figure .wide { margin: 0 0 .5rem; }
figure img, figure svg, .beal img { background: #fff; border-radius: 4px; }
figure img, figure svg { display: block; width: 100%; height: auto; min-width: 560px; }
figcaption { font-size: .87rem; line-height: 1.46; color: var(--soft); } figcaption b { color: var(--ink); }
.evidence { font-size: .88rem; line-height: 1.48; } .evidence li { margin-bottom: .35rem; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; font-size: .87em; }
pre { background: var(--tint); padding: .7rem 1rem; overflow-x: auto; }
var { font-style: italic; } sub, sup { line-height: 0; font-size: .74em; }
@media (max-width: 600px) { body { font-size: 16px; } main { padding-top: 1.4rem; } h1 { font-size: 1.5rem; }
  .eq { padding-left: .4rem; font-size: .96rem; } }
@media print { body { font-size: 10.5pt; } main { max-width: none; padding: 0; } nav { display: none; }
  a { color: inherit; text-decoration: none; } h2, h3 { break-after: avoid; } tr { break-inside: avoid; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } figure img, figure svg { min-width: 0; } }
"""
