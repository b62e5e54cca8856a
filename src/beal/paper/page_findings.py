"""The report's section on the printed equations: the argument, and numbers by which to check it."""

import math
from collections.abc import Callable

from beal.paper import cases, sketches
from beal.paper.findings import FOLDING, SIZES, SLIDING, SLIDING_THRUST, Findings, Joint
from beal.report import Page, table
from beal.report.html import Markup

CASE = "<i>L</i>₁ = {:g}, <i>k</i><sub>r</sub> = {:g}, <i>k</i><sub>s</sub> = {:g}"


def add_findings(page: Page, found: Findings, show: Callable[[str], None]) -> None:
    """Append findings a to e.

    Parameters
    ----------
    page : Page
    found : Findings
    show : callable
        Appends the figure of a name.
    """
    _sign(page, found)
    _truncation(page, found, show)
    _couple(page, found)
    _misprints(page, found)


def _case(joint: Joint) -> str:
    return CASE.format(*joint)


def _sign(page: Page, found: Findings) -> None:
    sign = found.sign
    page.section("finding-a", "4a &nbsp; A sign in Eq. (12)", level=3)
    page.text(
        "The admissible functions are the free modes, which the paper takes from the natural boundary conditions of "
        "Eq. (12). Those follow from the strain energy of Eq. (2). Vary it, integrate the bending terms by parts "
        "twice, and collect what multiplies the slope δ<i>φ</i>₁&prime; of the forward face and the slope "
        "δ<i>φ</i>₂&prime; of the aft face at the joint:"
    )
    page.equation(
        "[ <i>φ</i>₁″(<i>L</i>₁) + <i>k</i><sub>r</sub> (<i>φ</i>₁&prime;(<i>L</i>₁) &minus; <i>φ</i>₂&prime;(0)) ] "
        "δ<i>φ</i>₁&prime; &minus; [ <i>φ</i>₂″(0) + <i>k</i><sub>r</sub> (<i>φ</i>₁&prime;(<i>L</i>₁) &minus; "
        "<i>φ</i>₂&prime;(0)) ] δ<i>φ</i>₂&prime; = 0",
        "<i>φ</i>₁″(<i>L</i>₁) = <i>φ</i>₂″(0) = <i>k</i><sub>r</sub> [ <i>φ</i>₂&prime;(0) &minus; "
        "<i>φ</i>₁&prime;(<i>L</i>₁) ] &emsp; (right)",
        "<i>φ</i>₁″(<i>L</i>₁) = <i>φ</i>₂″(0) = <i>k</i><sub>r</sub> [ <i>φ</i>₁&prime;(<i>L</i>₁) &minus; "
        "<i>φ</i>₂&prime;(0) ] &emsp; (printed)",
    )
    page.text(
        "A positive jump of slope bends the spring open, so the moment has the sign of the jump. The shear line of "
        "Eq. (12) is right as printed. The printed rotational line describes a spring of stiffness "
        "&minus;<i>k</i><sub>r</sub>, which pushes the stages apart: the mode in which the vehicle folds at the "
        "joint then has a negative <i>λ</i>⁴. A search for positive <i>λ</i> does not find it, so the basis lacks "
        "just the shape that a soft joint needs, and further modes do not bring it back. The next table checks this "
        "twice: from the boundary conditions, and from the energies with &minus;<i>k</i><sub>r</sub> in place of "
        "<i>k</i><sub>r</sub>."
    )
    rows = [
        ("printed Eq. (12)", "not found", *(f"{value:.4f}" for value in sign.printed)),
        (Markup("energy with &minus;<i>k</i><sub>r</sub>"), *(_minus(value) for value in sign.energy)),
        ("right Eq. (12)", f"{sign.right[0]:.4f}", *(f"{value:.4f}" for value in sign.right[1:]), ""),
    ]
    head = ("<i>λ</i>⁴ of the mode", "fold", "2", "3", "4", "5")
    page.add(table(head, rows, f"Free modes of {_case(FOLDING)}.", numeric=range(1, 6)))
    loads = [(str(n), f"{printed:.6f}", f"{right:.6f}") for n, printed, right in sign.loads]
    loads.append(("converged", "", f"{sign.converged:.6f}"))
    signs = ("modes", "<i>P</i><sub>cr</sub>, printed sign", "<i>P</i><sub>cr</sub>, right sign")
    page.add(table(signs, loads, f"Critical thrust of {_case(FOLDING)} over the number of modes.", numeric=(1, 2)))


def _minus(value: float) -> Markup:
    return Markup(f"{value:.4f}".replace("-", "&minus;")).of_class("n")


def _exponent(value: float) -> str:
    """The power of ten above a small number."""
    return f"&minus;{-math.ceil(math.log10(value))}" if value > 0 else "&minus;16"


def _truncation(page: Page, found: Findings, show: Callable[[str], None]) -> None:
    page.section("finding-b", "4b &nbsp; Eight modes are not converged where a joint shears", level=3)
    page.text(
        "The modes of the unloaded vehicle all satisfy <i>φ</i>‴ = &minus;<i>k</i><sub>s</sub> [[<i>φ</i>]] at the "
        "joint. Under thrust the true shape does not: the shear force there also balances the axial force on the "
        "slope, <i>N y</i>&prime;. A sum of modes has to approach a condition that none of its terms meets, and does "
        "so slowly and unevenly. Polynomials on each stage carry no condition at the joint; the energy imposes it "
        "under any thrust, and they converge exponentially."
    )
    head = ("modes", *(_case(joint) for joint in found.truncation))
    rows = [(str(n), *(f"{dict(modes)[n]:.6f}" for modes, _, _ in found.truncation.values())) for n in SIZES]
    rows.append(("polynomials", *(f"{exact:.6f}" for _, _, exact in found.truncation.values())))
    eight = (f"{dict(modes)[8] / exact - 1:+.2%}" for modes, _, exact in found.truncation.values())
    rows.append(("error of 8 modes", *eight))
    caption = (
        "Critical thrust over the number of modes: right sign of Eq. (12), inertial shear axis, elastic modes only."
    )
    page.add(table(head, rows, caption, numeric=(1, 2, 3)))
    show("convergence")


def _couple(page: Page, found: Findings) -> None:
    page.section("finding-c", "4c &nbsp; The couple of the axial force in a sheared joint", level=3)
    caption = (
        "When the joint has slid by d, the axial forces on its two faces are no longer in line. They make a couple N d."
    )
    page.figure("couple", sketches.couple(), Markup("A sheared joint"), Markup(caption))
    page.text(
        "When the joint slides by <i>d</i> = [[<i>y</i>]], the axial force <i>N</i> pushes on two faces that are "
        "offset by <i>d</i>. Moments balance only if something carries the couple <i>N d</i>; in the paper's "
        "<i>W</i><sub>c</sub> nothing does. To see the consequence, turn the whole vehicle rigidly by a small angle "
        "<i>&alpha;</i>, and let the axial force and the thrust work on an elastic deflection <i>φ</i>. With "
        "<i>N</i>(0) = 0, <i>N</i>(<i>L</i>) = <i>P</i> and <i>N</i>&prime; = <i>P m</i>/<i>M</i>, integration by "
        "parts over both stages gives"
    )
    page.equation(
        "δ<i>W</i> = <i>&alpha;</i> [ ∫ <i>N φ</i>&prime; d<i>x</i> &minus; <i>P φ</i>(<i>L</i>) ] = "
        "&minus;<i>&alpha; N</i>(<i>L</i>₁) [[<i>φ</i>]] &minus; <i>&alpha;</i> (<i>P</i>/<i>M</i>) ∫ <i>m φ</i> "
        "d<i>x</i>"
    )
    page.text(
        "The last integral vanishes for every elastic mode, which is orthogonal to a translation. What is left says "
        "that turning the vehicle as a rigid body makes its joint slide, although thrust and axial force turn with "
        "it. The term <i>N</i> [[<i>y</i>]] <i>&sigma;</i> contributes +<i>&alpha; N</i>(<i>L</i>₁) [[<i>φ</i>]] and "
        "cancels it, provided that <i>&sigma;</i> turns with the vehicle: the slope of the forward face, of the aft "
        "face, or their mean. With <i>&sigma;</i> = 0 it stays. The test is simple: a rigid rotation strains "
        "nothing, so adding the rigid-body motions to the basis must not move the elastic frequencies."
    )
    rows = [
        (
            {"inertial": "fixed in space (paper)"}.get(c.axis, c.axis),
            f"{c.mu_without:.4f}",
            f"{c.mu_with:.4f}",
            f"{c.load_without:.5f}",
            f"{c.load_with:.5f}",
        )
        for c in found.couple
    ]
    head = (
        "shear axis <i>&sigma;</i>",
        "lowest <i>ω</i>², elastic modes",
        "with rigid-body modes",
        "<i>P</i><sub>cr</sub>, elastic modes",
        "with rigid-body modes",
    )
    caption = (
        f"Lowest root of {_case(SLIDING)} at <i>P</i> = {SLIDING_THRUST:g}, and critical thrust of "
        f"{_case(cases.RESPONSE_JOINT)}, with and without the rigid-body modes in the basis."
    )
    page.add(table(head, rows, caption, numeric=(1, 2, 3, 4)))


def _misprints(page: Page, found: Findings) -> None:
    page.section("finding-d", "4d, e &nbsp; The order of an index, and two misprints", level=3)
    page.text(
        "In Eq. (9) the follower term is <i>φ</i>₂<i>ᵢ</i>&prime;(1 &minus; <i>L</i>₁) <i>φ</i>₂<i>ⱼ</i>(1 &minus; "
        "<i>L</i>₁), with the virtual displacement as the <em>second</em> index; Eq. (8), <b>M</b> <b>q̈</b> + "
        "<b>K</b> <b>q</b> = <b>Q</b>, needs it as the first, so <b>K</b> has to be transposed. A matrix and its "
        "transpose have the same roots (largest relative difference here below "
        f"10<sup>{_exponent(found.transposed_roots)}</sup>), so the maps do not notice. The motions do: at <i>P</i> = "
        f"{cases.RESPONSE_THRUSTS[13]:g} the displacement of the IMU differs by up to {found.transposed_motion:.0%} "
        "of its largest value.",
        "The upper limit <i>L<sub>i</sub></i> of the first integrals in Eq. (9) should read <i>L</i>₁, and the last "
        "item of Eq. (6) defines <i>F</i>₀, not <i>P</i>₀.",
    )
