"""Missiles without damping: Beal's, with a concentrated mass, of two stages."""

from functools import partial

from beal.discretisation.build import Formulation
from beal.vehicle.catalog import beal, park_mote, tsto
from beal.verification.case import Case, Expected, at_thrust, called, divergence, exact, flutter, printed
from beal.verification.closed_forms import free_frequencies
from beal.verification.measure import critical, in_elements, suffix

FREQUENCIES = {
    5.0: ("21.6799291328", "60.7299372973", "119.875309102"),
    10.0: ("20.9746208872", "59.7670833121", "118.835956919"),
    20.0: ("19.5293673376", "57.7752726764", "116.72202804"),
    40.0: ("16.5307021782", "53.469416197", "112.342324166"),
    80.0: ("11.6300375901", "42.6033307991", "102.868931147"),
    100.0: ("13.9482741447", "34.0618162988", "97.6980376812"),
    109.0: ("20.328167441", "25.9266195294", "95.2585521461"),
}
CONCENTRATED_MASS = {
    (0.1, 0.0): flutter("96.7183810369", "19.2519689"),
    (0.1, 0.25): flutter("104.940010366", "21.4758374"),
    (0.1, 0.5): flutter("101.036089357", "26.5732568"),
    (0.1, 0.75): flutter("139.072631372", "20.1114221"),
    (0.1, 0.9): divergence("95.4478890322"),
    (0.1, 1.0): flutter("102.484308544", "18.3515935"),
    (0.5, 0.0): divergence("45.450903199"),
    (0.5, 0.25): divergence("79.2876753038"),
    (0.5, 0.5): flutter("86.2418360735", "30.5152476"),
    (0.5, 0.75): divergence("131.31431948"),
    (0.5, 0.9): divergence("84.8796602344"),
    (0.5, 1.0): divergence("67.5443922241"),
    (1.0, 0.0): divergence("34.2716146908"),
    (1.0, 0.25): divergence("60.2391085249"),
    (1.0, 0.5): flutter("79.4360982272", "31.5958684"),
    (1.0, 0.75): divergence("167.576895046"),
    (1.0, 0.9): divergence("102.578695789"),
    (1.0, 1.0): divergence("78.0657245412"),
    (0.2, 0.0, 0.01): flutter("62.759575606", "17.1029101309"),
    (0.1, 0.0, 0.001): flutter("92.0138898797", "19.5083724285"),
    (0.1, 1.0, 0.001): flutter("94.9043930268", "17.7856480645"),
}
QUOTED = (
    "0.19 % above the exact load: eight cubic elements, which give 109.874, round to it; where the 109.9 comes from is "
    "not known"
)
PAPER: dict[Formulation, tuple[str, str, str]] = {  # at a split of 0.6 and stiffnesses of 5000
    "as-printed": ("109.615937", "", "0.08 % below: the paper's equations as they are printed, in its eight modes"),
    "corrected-ritz": ("109.528403", "", "0.16 % below: with the sign of Eq. (12) that the paper's energy gives"),
    "converged": ("109.346441", "23.01319", "0.32 % below: the same equations, converged"),
    "objective": (
        "106.43723098",
        "22.8073151137",
        "3 % below: this joint keeps the couple of the axial force",
    ),
}
JOINTED: list[tuple[tuple[float | str, ...], Formulation, dict[str, Expected]]] = [
    ((0.8, 1e4, 1e4), "objective", flutter("108.590390538", "22.7821936583")),
    ((0.6, 5000.0, 5000.0, "forward"), "objective", flutter("106.432495928", "22.8076461823")),
    ((0.6, 5000.0, 5000.0, "aft"), "objective", flutter("106.441715253", "22.806962289")),
    ((0.6, 5000.0, 5000.0, "inertial"), "objective", flutter("107.989003255", "23.3307297756")),
    ((0.8, 1e4, 1e4), "converged", flutter("109.622066", of=", converged")),
    ((0.8, 200.0, 600.0), "converged", flutter("107.78176", "26.42055", of=", converged")),
    ((0.2, 1.0, 100.0), "converged", divergence("44.92481", of=", converged")),
    ((0.6, 1.0, 1e4), "converged", divergence("13.898275", of=", converged")),
    ((0.8, 1e4, 1e4), "corrected-ritz", flutter("116.786285", of=", corrected-ritz")),
    ((0.8, 200.0, 600.0), "corrected-ritz", flutter("108.204074", of=", corrected-ritz")),
    ((0.6, 1.0, 1e4), "corrected-ritz", divergence("13.941080", of=", corrected-ritz")),
    ((0.8, 200.0, 600.0), "as-printed", flutter("98.836918", of=", as-printed")),
    ((0.6, 1.0, 1e4), "as-printed", divergence("107.650146", of=", as-printed")),
]

CASES = [
    Case(
        *called(beal),
        "Beal (1965), quoted by Irani & Kavianipour (2009)",
        flutter("109.689191958738", "23.0733298844", printed("109.9"), QUOTED),
    ),
    Case(*called(beal), "Beal (1965)", flutter("109.874219", of=", 8 cubic elements"), partial(in_elements, count=8)),
    Case(
        *called(beal), "Beal (1965)", *at_thrust(0.0, [exact("b^2, cos b cosh b = 1", w) for w in free_frequencies(3)])
    ),
    *(Case(*called(beal), "Beal (1965)", *at_thrust(P, row)) for P, row in FREQUENCIES.items()),
    *(Case(*called(park_mote, *mass), "Park & Mote (1985)", expected) for mass, expected in CONCENTRATED_MASS.items()),
    *(
        Case(
            *called(tsto, 0.6, 5000.0, 5000.0),
            "Irani & Kavianipour (2009)",
            flutter(thrust, omega, printed("109.7"), reason, suffix(formulation)),
            partial(critical, formulation=formulation),
        )
        for formulation, (thrust, omega, reason) in PAPER.items()
    ),
    *(
        Case(*called(tsto, *joint), "Irani & Kavianipour (2009)", expected, partial(critical, formulation=formulation))
        for joint, formulation, expected in JOINTED
    ),
]
