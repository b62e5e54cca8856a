"""Columns without damping: Pflüger's, Reut's, those under distributed loads, Euler's."""

import math
from functools import partial

from beal.vehicle.catalog import euler, greenhill, hauger, leipholz, pflueger, reut
from beal.verification.case import Case, at_thrust, called, divergence, exact, flutter
from beal.verification.closed_forms import (
    beck_flutter,
    bessel_load,
    clamped_pinned_load,
    free_frequencies,
    pinned_frequencies,
)
from beal.verification.measure import in_elements

PI_2 = math.pi**2
PFLUEGER = {
    0.01: ("19.67131352678", "10.80318231182"),
    0.05: ("18.50727807815", "10.09194861373"),
    0.1: ("17.59528223473", "9.432781694329"),
    0.2: ("16.67616959605", "8.551691596708"),
    0.4: ("16.12290723298", "7.558963816295"),
    0.5: ("16.0615619664", "7.237055824457"),
    0.6: ("16.0541205594", "6.977244632218"),
    0.8: ("16.11376507986", "6.576223954778"),
    1.0: ("16.2121289425", "6.274504077761"),
    1.5: ("16.47952866121", "5.75036027353"),
    2.0: ("16.71678857174", "5.398578939063"),
    3.0: ("17.08564114211", "4.931766582472"),
    10.0: ("18.16343552782", "3.739525487693"),
    20.0: ("18.66839439634", "3.174721694773"),
    100.0: ("19.45437492106", "2.15237199865"),
    1000.0: ("19.94775832368", "1.220240908"),
}
PFLUEGER_ROTARY = {
    (0.5, 0.01): ("14.1167106745", "6.35978890611"),
    (1.0, 0.01): ("14.8522932418", "5.60966565152"),
    (0.0, 0.01): ("14.2478088351", "8.82267327204"),
    (2.0, 0.2): ("8.56743306015", "2.57191029569"),
}
EULER = {
    ("pinned", "pinned"): exact("pi^2", PI_2),
    ("clamped", "free"): exact("pi^2/4", PI_2 / 4),
    ("clamped", "pinned"): exact("x^2, tan x = x", clamped_pinned_load()),
    ("clamped", "clamped"): exact("4 pi^2", 4 * PI_2),
    ("clamped", "sliding"): exact("pi^2", PI_2),
    ("pinned", "sliding"): exact("pi^2/4", PI_2 / 4),
}
DEAD_LOADS = {
    ("clamped", "free"): {
        0.25: ("3.07349918564", "21.5753681666"),
        0.5: ("2.53456021607", "21.1051723546", "60.9194430451"),
        0.75: ("1.81130345957", "20.623377714"),
        0.9: ("1.15327608015", "20.3285100384"),
    },
    ("clamped", "pinned"): {
        0.0: ("15.418205717", "49.9648620318", "104.247696459"),
        0.25: ("13.3917717711", "47.7483310087"),
        0.5: ("10.970422211", "45.4229028237", "99.589874528"),
        0.75: ("7.7863231887", "42.9717381141"),
        0.9: ("4.93683803673", "41.4319692434"),
    },
    ("clamped", "clamped"): {
        0.25: ("19.4516833932", "57.8622383502"),
        0.5: ("15.9512876053", "53.7626429074", "112.534223341"),
        0.75: ("11.3341546151", "49.3000748602"),
        0.9: ("7.19135854758", "46.4041655301"),
    },
}

ADJOINT, ADJOINT_OMEGA = (exact("Beck's", value) for value in beck_flutter())
HAUGER = "quoted as 150.8; six cubic elements give 150.876 and eight 150.726"

CASES = [
    *(Case(*called(pflueger, mass), "Pflüger (1955)", flutter(*row)) for mass, row in PFLUEGER.items()),
    *(Case(*called(pflueger, *tip), "Pflüger (1955)", flutter(*row)) for tip, row in PFLUEGER_ROTARY.items()),
    Case(*called(reut), "Reut (1939)", flutter(ADJOINT, ADJOINT_OMEGA, ADJOINT)),
    Case(*called(leipholz), "Leipholz (1962)", flutter("40.0537365149396", "11.0302169953808")),
    Case(
        *called(leipholz),
        "Leipholz (1962)",
        flutter("40.0658785", of=", 8 cubic elements"),
        partial(in_elements, count=8),
    ),
    Case(
        *called(leipholz, "pinned", "pinned"),
        "Leipholz (1962)",
        divergence(PINNED := exact("9/4 j^2, J of order 1/3", bessel_load(1 / 3)), PINNED),
    ),
    Case(*called(leipholz, "clamped", "pinned"), "Leipholz (1962)", divergence("57.0077261443199")),
    Case(*called(leipholz, "clamped", "clamped"), "Leipholz (1962)", divergence("80.2557620563732")),
    Case(*called(hauger), "Hauger (1966)", flutter("150.641595404494", "11.4857136111294", reason=HAUGER)),
    Case(
        *called(hauger),
        "Hauger (1966)",
        flutter("150.7256777", of=", 8 cubic elements"),
        partial(in_elements, count=8),
    ),
    Case(
        *called(greenhill),
        "Greenhill (1881)",
        divergence(MAST := exact("9/4 j^2, J of order -1/3", bessel_load(-1 / 3)), MAST),
    ),
    *(Case(*called(euler, *ends), "Euler", divergence(load, load)) for ends, load in EULER.items()),
    *(
        Case(
            *called(euler, "pinned", "pinned"),
            "Bokaian (1988)",
            *at_thrust(P, [exact("n^2 pi^2 sqrt(1 - P/(n pi)^2)", w) for w in pinned_frequencies(P, 3)]),
        )
        for P in (share * PI_2 for share in (0.0, 0.25, 0.5, 0.75, 0.9))
    ),
    Case(
        *called(euler, "clamped", "clamped"),
        "Bokaian (1988)",
        *at_thrust(0.0, [exact("b^2, cos b cosh b = 1", w) for w in free_frequencies(3)]),
    ),
    *(
        Case(*called(euler, *ends), "Bokaian (1988)", *at_thrust(share * EULER[ends].value, row))
        for ends, rows in DEAD_LOADS.items()
        for share, row in rows.items()
    ),
]
