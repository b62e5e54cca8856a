"""Beck's column and its variants without damping."""

import math
from functools import partial

from beal.vehicle.catalog import (
    beck,
    beck_cracked,
    beck_on_foundation,
    beck_on_springs,
    beck_subtangential,
    beck_tapered,
)
from beal.verification.case import Case, at_thrust, called, divergence, exact, flutter, printed
from beal.verification.closed_forms import beck_flutter, beck_frequencies, subtangential_divergence
from beal.verification.measure import in_elements

THRUST, OMEGA = beck_flutter()
BECK, BECK_OMEGA = exact("double root of his equation", THRUST), exact("double root of his equation", OMEGA)

SUBTANGENTIAL = {
    0.55: ("16.1085099717", "7.76273176244"),
    0.6: ("16.2589695962", "8.33444171003"),
    0.8: ("17.5891735398", "9.94656438804"),
    0.9: ("18.6683837522", "10.5295522885"),
    1.1: ("21.7628266336", "11.4128470427"),
    1.2: ("23.7972167295", "11.7176817467"),
    1.5: ("30.6280672201", "12.055584233"),
}
NOSE_SPRING = {
    0.1: ("18.1634355278", "3.73952548769"),
    1.0: ("16.2121289425", "6.27450407776"),
    5.0: ("16.6761695961", "8.55169159671"),
    10.0: ("17.5952822347", "9.43278169433"),
}
TAIL_SPRING = {
    1.0: flutter("20.389915335", "11.0514002843"),
    5.0: flutter("21.91900579", "11.1153892568"),
    10.0: flutter("24.2240402684", "11.0025922092"),
    30.0: flutter("35.8008238574", "8.29189177583"),
    34.8: flutter("38.2761266466", "7.21653869962"),
    35.0: divergence("32.0547602231"),
    100.0: divergence("22.3148577697"),
    1000.0: divergence("20.3787977885"),
}
TAPERED = {0.2: ("18.2669761063", "11.5381164097"), 0.5: ("15.6265309645", "12.731591193")}
CRACKED = {  # station and stiffness
    (0.1, 1.0): ("19.7615315894", "7.50955075549"),
    (0.1, 5.0): ("19.2705204209", "9.53783531091"),
    (0.1, 10.0): ("19.4669773559", "10.1369103955"),
    (0.1, 20.0): ("19.6843825821", "10.5282606377"),
    (0.1, 50.0): ("19.8810074249", "10.8066177224"),
    (0.1, 100.0): ("19.9615032848", "10.9084880475"),
    (0.25, 1.0): ("20.11758764", "9.6212237218"),
    (0.25, 5.0): ("19.9996500513", "10.6545106297"),
    (0.25, 10.0): ("20.0164467307", "10.8284488121"),
    (0.25, 20.0): ("20.0310950476", "10.9203116376"),
    (0.25, 50.0): ("20.0423264709", "10.9770492115"),
    (0.25, 100.0): ("20.046520818", "10.9962348491"),
    (0.5, 1.0): ("6.15884102509", "6.96028799684"),
    (0.5, 5.0): ("12.9267275327", "9.30746211681"),
    (0.5, 10.0): ("15.7364033548", "10.0222856734"),
    (0.5, 20.0): ("17.6576935876", "10.4766603172"),
    (0.5, 50.0): ("19.030370157", "10.7888955199"),
    (0.5, 100.0): ("19.5295842493", "10.9003048165"),
}

CASES = [
    Case(*called(beck), "Beck (1952), quoted by Bažant & Cedolin", flutter(BECK, BECK_OMEGA, printed("20.05"))),
    *(
        Case(*called(beck), "Beck (1952)", *at_thrust(P, [exact("his equation", w) for w in beck_frequencies(P, 3)]))
        for P in (0.0, 5.0, 10.0, 15.0, 20.0)
    ),
    Case(*called(beck), "Beck (1952)", flutter("20.0542838", of=", 8 cubic elements"), partial(in_elements, count=8)),
    *(
        Case(
            *called(beck_on_foundation, k),
            "Smith & Herrmann (1972)",
            flutter(BECK, exact("sqrt(W + k)", math.sqrt(OMEGA**2 + k)), exact("Beck's, whatever k", THRUST)),
        )
        for k in (1.0, 10.0, 100.0)
    ),
    *(
        Case(
            *called(beck_subtangential, eta),
            "Bolotin (1963)",
            divergence(load := exact("cos sqrt(P) = -eta/(1 - eta)", subtangential_divergence(eta)), load),
        )
        for eta in (0.0, 0.1, 0.2, 0.3, 0.36, 0.4, 0.45, 0.49)
    ),
    *(Case(*called(beck_subtangential, eta), "Bolotin (1963)", flutter(*row)) for eta, row in SUBTANGENTIAL.items()),
    *(
        Case(*called(beck_on_springs, nose_rotation=k), "Kounadis (1977)", flutter(*row))
        for k, row in NOSE_SPRING.items()
    ),
    *(Case(*called(beck_on_springs, tail_translation=k), "Kounadis (1977)", row) for k, row in TAIL_SPRING.items()),
    *(Case(*called(beck_tapered, taper), "Computed here", flutter(*row)) for taper, row in TAPERED.items()),
    *(Case(*called(beck_cracked, *crack), "Wang (2004)", flutter(*row)) for crack, row in CRACKED.items()),
]
