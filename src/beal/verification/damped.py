"""Columns and missiles with damping, and in the limit of vanishing damping."""

from beal.vehicle.catalog import beal, beck_damped, mladenov_sugiyama, pflueger
from beal.verification.case import Case, called, flutter
from beal.verification.measure import vanishing

BOLOTIN = "Bolotin & Zhinzher (1969)"
TOMMASINI = "Tommasini et al. (2016)"
MLADENOV = "Mladenov & Sugiyama (1997)"
VANISHING = ", vanishing damping"
BECK = {  # internal and external damping
    (1e-4, 0.0): ("10.9388520721", "5.398613937228"),
    (1e-3, 0.0): ("10.93912199698", "5.398624783601"),
    (0.005, 0.0): ("10.945665459", "5.398887706941"),
    (0.01, 0.0): ("10.96611165947", "5.399709107125"),
    (0.02, 0.0): ("11.04786449167", "5.402991156265"),
    (0.05, 0.0): ("11.61873610921", "5.42580985753"),
    (0.1, 0.0): ("13.6393176099", "5.50525777434"),
    (0.2, 0.0): ("21.51013537701", "5.798541273015"),
    (0.0, 0.1): ("20.05148217776", "11.01540038453"),
    (0.0, 1.0): ("20.10368483253", "10.9998564319"),
    (0.0, 5.0): ("21.29674511226", "10.63751647547"),
    (0.0, 20.0): ("30.13821341618", "7.325646523015"),
    (0.001, 0.1): ("17.5501075086", "7.809990484701"),
    (0.01, 1.0): ("17.79406486219", "7.782337374336"),
    (0.02, 2.0): ("18.51610192857", "7.699308027545"),
}
BECK_LIMIT: dict[tuple[float, ...], tuple[str, str]] = {  # and tangency
    (1.0,): ("10.938849345588", "5.3986138276688"),
    (1.0, 10.0): ("12.8817610272", "5.92253884826"),
    (0.01, 1.0): ("17.5476286924", "7.81027044473"),
    (1e-3, 1.0): ("19.9011181258", "10.1865347818"),
    (1.0, 0.0, 0.6): ("9.378831982011", "2.610127965411"),
    (1.0, 0.0, 0.8): ("9.527962726592", "4.21377039267"),
}
PFLUEGER_LIMIT = {  # mass ratio and damping
    (0.1, "internal_damping"): ("9.541813193013", "4.551275377373"),
    (1.0, "internal_damping"): ("7.905071679219", "2.387238534226"),
    (0.1, "external_damping"): ("17.4537613673", "10.2145158162"),
    (1.0, "external_damping"): ("16.1215533151", "5.72611441924"),
}
BEAL = {1e-4: ("88.1528218341", "11.7238348461"), 1e-3: ("88.1717716974", "11.7165780671")}
TURNING = {  # station and stiffness of the joint, internal damping and the joint's
    (0.75, 5.0, 1e-4, 0.0): ("47.8040495228", "18.14016833"),
    (0.75, 5.0, 1e-3, 0.005): ("45.359131156", "17.5097692853"),
    (0.75, 10.0, 1e-3, 0.1): ("47.4890190666", "16.2063590505"),
    (0.75, 20.0, 1e-3, 0.02): ("71.0978348932", "15.1987012931"),
    (0.75, 100.0, 1e-3, 0.1): ("84.3212214035", "12.6673304853"),
    (0.25, 5.0, 1e-2, 0.05): ("83.8877542747", "7.19206861766"),
    (0.25, 100.0, 1e-3, 0.1): ("87.7955777444", "11.6109662383"),
    (0.5, 20.0, 1e-2, 0.2): ("90.106719889", "3.37149452535"),
    (0.5, 100.0, 1e-2, 1.0): ("89.810392317", "9.98423981524"),
    (0.75, 30.0, 0.0, 1.0): ("37.7625673832", "16.8701651616"),  # the joint's alone: whatever joint and dashpot
    (0.75, 300.0, 0.0, 1.0): ("37.7625673832", "16.8701651616"),
    (0.25, 30.0, 0.0, 1.0): ("96.680075519", "12.9751765961"),
}
SHEARING = {
    (0.5, 100.0, 1e-3, 0.1): ("52.7804503216", "16.7576018599"),
    (0.5, 1000.0, 1e-3, 1.0): ("81.2478882784", "12.817543573"),
}

CASES = [
    *(Case(*called(beck_damped, *damping), BOLOTIN, flutter(*row)) for damping, row in BECK.items()),
    *(
        Case(*called(beck_damped, *damping), BOLOTIN, flutter(*row, of=VANISHING), vanishing)
        for damping, row in BECK_LIMIT.items()
    ),
    *(
        Case(*called(pflueger, mass, **{damping: 1.0}), TOMMASINI, flutter(*row, of=VANISHING), vanishing)
        for (mass, damping), row in PFLUEGER_LIMIT.items()
    ),
    *(Case(*called(beal, internal_damping=damping), "Beal (1965)", flutter(*row)) for damping, row in BEAL.items()),
    Case(
        *called(beal, internal_damping=1.0),
        "Beal (1965)",
        flutter("88.1526301826", "11.7239082145", of=VANISHING),
        vanishing,
    ),
    *(
        Case(
            *called(mladenov_sugiyama, x, k_r, internal_damping=internal, rotational_damping=joint),
            MLADENOV,
            flutter(*row),
        )
        for (x, k_r, internal, joint), row in TURNING.items()
    ),
    *(
        Case(
            *called(mladenov_sugiyama, x, shear_stiffness=k_s, internal_damping=internal, shear_damping=joint),
            MLADENOV,
            flutter(*row),
        )
        for (x, k_s, internal, joint), row in SHEARING.items()
    ),
]
