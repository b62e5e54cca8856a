"""The report: what was done, what agrees with the paper, what does not and why; all numbers come from the results."""

import re
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np

from beal.discretisation.build import Formulation
from beal.paper import cases, sketches
from beal.paper.claims import Verdict
from beal.paper.evidence import Maps, critical
from beal.paper.figures import Drawing
from beal.paper.findings import Findings
from beal.paper.page_findings import add_findings
from beal.report import Page, data_uri, table
from beal.report.html import Markup
from beal.study.variables import STATUS

TITLE = "A flexible joint under follower thrust: Irani & Kavianipour (2009) computed again"
SYMBOLS = {"holds": ("holds", "holds"), "holds in part": ("part", "in part"), "fails": ("fails", "fails")}
AS_PNG = {"fig04", "fig06", "fig08", "fig11"}  # many cells: lighter as pixels
LAST_MODE = 4  # of those that the paper looked at
STIFF = 1e3  # spring above which a joint counts as stiff in the comparison


def pretty(text: str) -> Markup:
    """Plain text as HTML: escaped, with italic letters, subscripts and dashes between numbers.

    Parameters
    ----------
    text : str

    Returns
    -------
    Markup

    Examples
    --------
    >>> pretty("P_cr of modes 1-2 for k_r < 3")
    '<i>P</i><sub>cr</sub> of modes 1&ndash;2 for <i>k</i><sub>r</sub> &lt; 3'
    """
    html = escape(text, quote=False)
    html = re.sub(r"\b(k|P)_(r|s|cr)\b", r"<i>\1</i><sub>\2</sub>", html)
    html = re.sub(r"(?<![\w.^-])(\d)-(\d)(?![\w.]\d)", r"\1&ndash;\2", html)
    html = re.sub(r"(?<![\w>])-(\d)", r"&minus;\1", html)
    return Markup(re.sub(r"(\d)e([+-])0?(\d+)\b", _power, html).replace("L₁", "<i>L</i>₁"))


def _power(match: re.Match[str]) -> str:
    return f"{match[1]}·10<sup>{'&minus;' if match[2] == '-' else ''}{match[3]}</sup>"


def report(
    drawings: Sequence[Drawing],
    pictures: Mapping[str, Mapping[str, bytes]],
    verdicts: Sequence[Verdict],
    found: Findings,
    charts: Maps,
    points: int,
) -> str:
    """The page as one self-contained HTML document.

    Parameters
    ----------
    drawings : sequence of Drawing
    pictures : dict of name to dict of kind to content
    verdicts : sequence of Verdict
    found : Findings
    charts : dict of (L1, formulation) to Dataset
    points : int
        Per axis of each map.

    Returns
    -------
    str
    """
    page = Page(TITLE, "The figures, tables and verdicts on this page were computed by one command.")
    named = {drawing.name: drawing for drawing in drawings}

    def show(name: str) -> None:
        drawing, kind = named[name], "png" if name in AS_PNG else "svg"
        source = data_uri(pictures[name][kind], kind)
        picture = f'<img src="{source}" alt="{escape(drawing.title)}">'
        page.figure(name, picture, pretty(drawing.title), pretty(drawing.caption))

    _abstract(page, verdicts, found)
    _model(page)
    _agreement(page, charts, verdicts)
    _claims(page, verdicts, points)
    page.section("findings", "4 &nbsp; Three findings about the printed equations")
    add_findings(page, found, show)
    page.section("figures", "5 &nbsp; The figures of the paper, computed again")
    page.text(
        "Where the paper gives no spring stiffness or initial condition, one was chosen and the caption says so. The "
        "file names are those of the data beside this page: for each figure a <code>.png</code>, an "
        "<code>.svg</code> and a <code>.csv</code>."
    )
    for drawing in drawings:
        if drawing.name != "convergence":
            show(drawing.name)
    _method(page, charts, points)
    return page.html()


def _abstract(page: Page, verdicts: Sequence[Verdict], found: Findings) -> None:
    loads = {name: critical(cases.RESPONSE_JOINT, name).critical_thrust for name in cases.ORDER}
    sign, (sheared, *_) = found.sign, found.truncation.items()
    joint, (modes, _, exact) = sheared
    eight = dict(modes)[8]
    soft = next(printed for n, printed, _ in sign.loads if n == 8)
    tally = "; ".join(
        f"{cases.NAMES[name]}: {_count(verdicts, name, 'holds')} hold, {_count(verdicts, name, 'holds in part')} in "
        f"part, {_count(verdicts, name, 'fails')} fail"
        for name in cases.ORDER
    )
    page.add('<div class="abstract">')
    page.text(
        "A two-stage launch vehicle is modelled as two beams joined by a rotational and a shear spring and pushed by "
        "a thrust that follows its tail. Irani and Kavianipour (2009) asked how that joint changes the thrust at "
        "which the vehicle flutters or diverges. All their figures are regenerated here under four formulations, "
        "from the equations as printed to a converged solution of a joint that balances moments, and nine claims of "
        "theirs are tested one by one.",
        f"For the paper's worked example ({pretty(cases.joint_text(cases.RESPONSE_JOINT))}; printed value "
        f"{cases.PAPER_CRITICAL}) the critical thrust <i>P</i><sub>cr</sub><i>L</i>²/<i>EI</i> is {_list(loads)}. For "
        f"a soft rotational spring ({pretty(cases.joint_text(sign.joint))}) the printed sign of Eq. (12) gives "
        f"{soft:.3f} where the right one gives {sign.converged:.3f}, a factor of {soft / sign.converged:.1f}; and "
        f"where a joint shears, eight modes are not enough ({pretty(cases.joint_text(joint))}: {eight:.3f} against "
        f"{exact:.3f} converged).",
        f"Verdicts on the nine claims: {tally}.",
    )
    page.add("</div>")
    page.add(
        "<nav>"
        + " ".join(
            f'<a href="#{anchor}">{title}</a>'
            for anchor, title in (
                ("model", "1 Model"),
                ("agreement", "2 What agrees"),
                ("claims", "3 Claims"),
                ("findings", "4 Findings"),
                ("figures", "5 Figures"),
                ("method", "6 Method"),
                ("again", "7 Do it again"),
            )
        )
        + "</nav>"
    )


def _list(loads: Mapping[Formulation, float | None]) -> str:
    return ", ".join(f"{load:.3f} ({cases.NAMES[name]})" for name, load in loads.items())


def _count(verdicts: Sequence[Verdict], formulation: Formulation, verdict: str) -> int:
    return sum(v.formulation == formulation and v.verdict == verdict for v in verdicts)


def _model(page: Page) -> None:
    page.section("model", "1 &nbsp; The vehicle and four ways to formulate it")
    caption = (
        "Two uniform stages of equal mass per length m and bending stiffness EI, free at both ends; rotational "
        "spring k_r and shear spring k_s between them; thrust P along the tangent of the tail; transverse force F(t) "
        "at the tail; a sensor (IMU) at a fifth of the upper stage."
    )
    page.figure("fig01", sketches.vehicle(), Markup("Fig. 1. The vehicle"), pretty(caption))
    page.text(
        "With the deflection <i>y</i>(<i>x</i>, <i>t</i>) from the nose to the tail, [[<i>f</i>]] the jump of "
        "<i>f</i> across the joint (aft minus forward) and the axial force <i>N</i> = <i>P x</i>/<i>L</i> that "
        "accelerates what lies ahead of <i>x</i>,"
    )
    page.equation(
        "<i>V</i> = ½ ∫ <i>EI y</i>″² d<i>x</i> + ½ <i>k</i><sub>r</sub> [[<i>y</i>&prime;]]² + ½ "
        "<i>k</i><sub>s</sub> [[<i>y</i>]]²",
        "<i>W</i> = ½ ∫ <i>N y</i>&prime;² d<i>x</i> + <i>N</i>(<i>L</i>₁) [[<i>y</i>]] <i>&sigma;</i>, &emsp; "
        "δ<i>W</i><sub>nc</sub> = &minus;<i>P y</i>&prime;(<i>L</i>) δ<i>y</i>(<i>L</i>) + <i>F</i> "
        "δ<i>y</i>(<i>L</i>)",
    )
    page.text(
        "where <i>&sigma;</i> is the slope of the line along which the shear spring slides: zero in the paper, the "
        "mean slope of both faces of the joint by default here (section 4c). In the non-dimensional form of the "
        "paper's Eq. (6) lengths are divided by <i>L</i>, forces by <i>EI</i>/<i>L</i>², <i>k</i><sub>r</sub> by "
        "<i>EI</i>/<i>L</i>, <i>k</i><sub>s</sub> by <i>EI</i>/<i>L</i>³ and time by "
        "(<i>mL</i>⁴/<i>EI</i>)<sup>1/2</sup>. All numbers below are non-dimensional. The vehicle flutters where two "
        "natural frequencies meet, and diverges where one vanishes."
    )
    rows = [
        ("as printed", "printed sign of Eq. (12)", "fixed in space", "8 modes of Eq. (10)", "left out"),
        ("corrected Ritz", "right sign", "fixed in space", "8 modes", "left out"),
        ("converged", "from the energy", "fixed in space", "polynomials, converged", "left out"),
        ("objective", "from the energy", "mean slope of the faces", "polynomials, converged", "no effect on the roots"),
    ]
    head = ("formulation", "condition at the joint", "shear axis", "basis", "rigid-body modes")
    page.add(
        table(
            head,
            rows,
            "The four formulations. The first is what the paper prints; the last is the default of the program.",
        )
    )


def _agreement(page: Page, charts: Maps, verdicts: Sequence[Verdict]) -> None:
    page.section("agreement", "2 &nbsp; What agrees, what does not, and why")
    page.text(
        "The table compares the maps point by point. Two formulations agree on a point's <em>label</em> where kind "
        "and mode pair are the same; joints count as stiff where both springs are at least 1000."
    )
    pairs: tuple[tuple[Formulation, Formulation], ...] = (
        ("as-printed", "corrected-ritz"),
        ("corrected-ritz", "converged"),
        ("converged", "objective"),
        ("as-printed", "objective"),
    )
    rows = []
    for one, other in pairs:
        for split in cases.LOCATIONS:
            label, stiff, whole = _compare(charts, split, one, other)
            what = f"{cases.NAMES[one]} / {cases.NAMES[other]}" if split == cases.LOCATIONS[0] else ""
            rows.append((what, f"{split:g}", f"{label:.1%}", f"{stiff:.2%}", f"{whole:.1%}"))
    head = (
        "formulations",
        "<i>L</i>₁",
        "same label",
        "largest change of <i>P</i><sub>cr</sub>, stiff joints",
        "over the whole map",
    )
    page.add(
        table(
            head, rows, "Agreement of the maps. A change is relative to the second formulation.", numeric=(1, 2, 3, 4)
        )
    )
    best = max(cases.ORDER, key=lambda name: _count(verdicts, name, "holds"))
    share = {name: _share(verdicts, name) for name in cases.ORDER}
    closest = max(cases.ORDER, key=share.__getitem__)
    page.text(
        f"The published statements are borne out most often by the formulation <em>{cases.NAMES[closest]}</em>: on "
        f"average over all parts of all claims, {_listed(share)} of the cases agree. Most claims hold without reserve "
        f"under <em>{cases.NAMES[best]}</em>.",
        "Three causes explain the differences, one for each step of the table of formulations. From <em>as "
        "printed</em> to <em>corrected Ritz</em> only a sign changes; it matters where the rotational spring is "
        "soft, because the printed sign removes the mode in which the vehicle folds (4a). From there to "
        "<em>converged</em> only the number of functions changes; it matters where the joint shears under thrust "
        "(4b). From there to <em>objective</em> the axial force is carried through the sheared joint without an "
        "unbalanced couple; it matters where the shear spring is soft (4c).",
    )


def _compare(charts: Maps, split: float, one: Formulation, other: Formulation) -> tuple[float, float, float]:
    """Share of equal labels, and the largest relative change of the load on stiff joints and overall."""
    a, b = charts[split, one], charts[split, other]
    same = np.all([np.asarray(a[name]) == np.asarray(b[name]) for name in ("kind", "mode_low", "mode_high")], axis=0)
    change = abs(np.asarray(a.critical_thrust) / np.asarray(b.critical_thrust) - 1)
    stiff = np.ix_(np.asarray(a[cases.K_R]) >= STIFF, np.asarray(a[cases.K_S]) >= STIFF)
    return float(same.mean()), float(np.nanmax(change[stiff])), float(np.nanmax(change))


def _share(verdicts: Sequence[Verdict], formulation: Formulation) -> float:
    parts = [part for verdict in verdicts if verdict.formulation == formulation for part in verdict.parts]
    return float(np.mean([part.borne_out / part.cases for part in parts]))


def _listed(share: Mapping[Formulation, float]) -> str:
    return ", ".join(f"{value:.0%} ({cases.NAMES[name]})" for name, value in share.items())


def _claims(page: Page, verdicts: Sequence[Verdict], points: int) -> None:
    page.section("claims", "3 &nbsp; Nine claims, tested one by one")
    page.text(
        "Each claim is split into parts that can be counted. A claim <em>holds</em> where every case of every part "
        "bears it out; it <em>fails</em> where, on average over its parts, fewer than half of the cases do; in "
        "between it holds <em>in part</em>. The counts follow below the table, and in <code>claims.json</code>. Maps "
        f"were computed on {points} by {points} points, logarithmic in <i>k</i><sub>r</sub> from 1 to 10⁴ and in "
        "<i>k</i><sub>s</sub> from 10² to 10⁴."
    )
    claims = {verdict.id: verdict.claim for verdict in verdicts}
    rows = []
    for number, claim in claims.items():
        row = [number, pretty(claim)]
        for name in cases.ORDER:
            verdict = _of(verdicts, number, name)
            look, word = SYMBOLS[verdict.verdict]
            row.append(Markup(f'<span class="v">{word}</span><br>{_mean(verdict):.0%}').of_class(look))
        rows.append(row)
    head = ("", "claim of the paper", *(cases.NAMES[name] for name in cases.ORDER))
    page.add(table(head, rows, "Verdicts, with the average share of cases that bear the parts out."))
    for number, claim in claims.items():
        page.section(number.lower(), f"{number} &nbsp; {pretty(claim)}", level=3)
        judged = [_of(verdicts, number, name) for name in cases.ORDER]
        parts = zip(*(verdict.parts for verdict in judged), strict=True)
        rows = [[pretty(same[0].statement), *(part.count for part in same)] for same in parts]
        page.add(table(("", *(cases.NAMES[name] for name in cases.ORDER)), rows, numeric=range(1, 5)))
        notes = [(cases.NAMES[v.formulation], v.note) for v in judged if v.note]
        items = "".join(f"<li><b>{name}.</b> {pretty(note)}</li>" for name, note in notes)
        page.add(f'<ul class="evidence">{items}</ul>' if items else "")
        page.add(f'<p class="evidence">Tested on {pretty(judged[0].grid)}.</p>')


def _of(verdicts: Sequence[Verdict], number: str, formulation: Formulation) -> Verdict:
    return next(v for v in verdicts if v.id == number and v.formulation == formulation)


def _mean(verdict: Verdict) -> float:
    return float(np.mean([part.borne_out / part.cases for part in verdict.parts]))


def _method(page: Page, charts: Maps, points: int) -> None:
    page.section("method", "6 &nbsp; Method and errors")
    exact = [charts[split, name] for split in cases.LOCATIONS for name in ("converged", "objective")]
    ritz = [charts[split, name] for split in cases.LOCATIONS for name in ("as-printed", "corrected-ritz")]
    errors = [
        max(float(np.nanmax(chart.error_estimate / chart.critical_thrust)) for chart in group)
        for group in (exact, ritz)
    ]
    every = [*exact, *ritz]
    failed = sum(int((chart.status != STATUS.index("solved")).sum()) for chart in every)
    total = sum(chart.status.size for chart in every)
    higher = sum(int((chart.mode_high > LAST_MODE).sum()) for chart in every)
    page.text(
        "The equations <b>M</b> <b>q̈</b> + (<b>K</b>₀ + <i>P</i> <b>K</b>₁) <b>q</b> = <b>f</b> come from the "
        "energies of section 1, with Legendre polynomials on each stage (<em>converged</em>, <em>objective</em>) or "
        "the exact modes of the unloaded vehicle (the two Ritz formulations). <b>K</b>₁ is not symmetric. The "
        "critical thrust is the smallest at which two roots ω² meet and turn complex, or one passes through zero; it "
        "is found by following the extrema of the characteristic polynomial between neighbouring roots, so that no "
        "sweep in small steps can pass over a narrow tongue, and polished on the full matrices as a double root. The "
        "polynomials' degree is raised until the last change is below the tolerance.",
        f"Over the {total} points of the sixteen maps, {failed} could not be solved. The largest relative error "
        f"estimate is {pretty(f'{errors[0]:.0e}')} for the polynomial formulations (discretisation and rounding) and "
        f"{pretty(f'{errors[1]:.0e}')} for the Ritz formulations, where the eight modes belong to the definition and "
        "only rounding is estimated. Eight elastic modes and more are watched, up to the thrust that would buckle "
        "the vehicle in five half waves as a dead load; an instability beyond either is not seen. The paper looked "
        f"at the first {LAST_MODE} frequencies only; at {higher} points of the maps a pair of higher modes flutters "
        "first, and is counted as such.",
        "As a check, the uniform beam under the same follower thrust has a closed characteristic equation and "
        f"flutters at {cases.UNIFORM:.6f}; the paper quotes {cases.PAPER_UNIFORM} after Beal (1965). Motions are "
        "those of the elastic modes, as in the paper, by Newmark's method and, as a check, by the matrix "
        "exponential; each caption states the largest difference.",
    )
    page.section("again", "7 &nbsp; Do it again")
    page.add("<pre>make demo</pre>")
    page.text(
        f"or, where the package is installed, <code>beal reproduce -o out --points {points}</code>. That writes this "
        "page, the figures as PNG and SVG, the data behind each as CSV with a line that defines the columns, and "
        "<code>claims.json</code>."
    )
    page.section("references", "References")
    page.text(
        "Beal, T. R., 1965. Dynamic stability of a flexible missile under constant and pulsating thrusts. <i>AIAA "
        "Journal</i>, 3(3), 486&ndash;494.",
        "Irani, S., Kavianipour, O., 2009. Effects of a flexible joint on instability of a free-free jointed "
        "bipartite beam under the follower and transversal forces. <i>Journal of Zhejiang University SCIENCE A</i>, "
        "doi:10.1631/jzus.A0820621.",
        "Newmark, N. M., 1959. A method of computation for structural dynamics. <i>Journal of the Engineering "
        "Mechanics Division</i>, 85(3), 67&ndash;94.",
    )
