"""The key numbers behind the paper's figures stay what they were.

To write the golden file anew, after a change that is meant to move them:

    python tests/regression/test_paper_figures.py
"""

import json
from pathlib import Path

import numpy as np
import pytest

from beal.discretisation import FORMULATIONS
from beal.discretisation.joint_modes import joint_modes
from beal.paper import cases
from beal.paper.evidence import critical, forced_amplitude, growth, motion
from beal.paper.findings import AXES, _couple
from beal.stability.curve import thrust_curve
from beal.study.map import stability_map
from beal.vehicle.catalog import tsto

GOLDEN = Path(__file__).with_name("paper_figures.json")
COMMAND = "python tests/regression/test_paper_figures.py"
POINTS = 4
EXACT = 1e-8  # critical points are double roots polished to some 1e-11; what other machines round differently is less
MAP = 2e-6  # maps are solved to a relative tolerance of 1e-6


def wavenumbers():
    """Fig. 2."""
    return {sign: joint_modes(0.2, 3000.0, 3000.0, 4, sign).wavenumbers.tolist() for sign in ("printed", "natural")}


def loads():
    """Figs. 3, 5, 7, 9, 10 and 12, and the vehicle of the responses."""
    joints = [case.joint for case in cases.CURVES] + [cases.RESPONSE_JOINT]
    return {
        f"{joint} {name}": [found.kind, *found.modes, found.critical_thrust, found.angular_frequency]
        for joint in joints
        for name in FORMULATIONS
        for found in (critical(joint, name),)
    }


def frequencies():
    """The four frequencies of each of those figures at half of its reach."""
    return {
        f"{case.joint} {name}": thrust_curve(tsto(*case.joint), case.reach / 2, 27, formulation=name)
        .angular_frequency[-1]
        .tolist()
        for case in cases.CURVES
        for name in ("as-printed", "objective")
    }


def maps():
    """Figs. 4, 6, 8 and 11 on a coarse grid."""
    axes = {
        cases.K_R: np.geomspace(*cases.ROTATIONAL, POINTS).tolist(),
        cases.K_S: np.geomspace(*cases.SHEAR, POINTS).tolist(),
    }
    found = {}
    for split in cases.LOCATIONS:
        for name in FORMULATIONS:
            chart = stability_map(tsto(split, 1.0, 100.0), axes, formulation=name)
            labels = [np.asarray(chart[v]).astype(int).ravel().tolist() for v in ("kind", "mode_low", "mode_high")]
            found[f"{split} {name}"] = [*labels, np.asarray(chart.critical_thrust).ravel().tolist()]
    return found


def motions():
    """Growth rates and displacements behind Figs. 13 and 14, amplitudes behind Fig. 15."""
    return {
        name: [
            growth(cases.RESPONSE_JOINT, name, 90.0, 4.0).amplitude_ratio,
            growth(cases.RESPONSE_JOINT, name, 128.0, 2.0).eigenvalue_rate,
            *motion(tsto(*cases.RESPONSE_JOINT), name, 90.0, 1.0, free=True).exact.displacement[0][::500].tolist(),
            *(forced_amplitude(name, thrust, 0.01) for thrust in cases.FORCED_THRUSTS),
        ]
        for name in FORMULATIONS
    }


def couples():
    """The table of finding c."""
    return {c.axis: [c.mu_without, c.mu_with, c.load_without, c.load_with] for c in map(_couple, AXES)}


WHAT = {
    "wavenumbers": (wavenumbers, EXACT),
    "loads": (loads, EXACT),
    "frequencies": (frequencies, EXACT),
    "maps": (maps, MAP),
    "motions": (motions, 1e-6),  # of the expansion in a finite set of modes, whose highest are worth no more
    "couples": (couples, EXACT),
}


@pytest.mark.parametrize("name", WHAT)
def test_the_figures_keep_their_numbers(name):
    make, tolerance = WHAT[name]
    golden = json.loads(GOLDEN.read_text(encoding="utf-8"))[name]
    found = make()
    assert list(found) == list(golden)
    for key, values in golden.items():
        assert flat(found[key]) == flat(values, tolerance), key


def flat(values, tolerance=None):
    """One list of names and numbers; the numbers with a tolerance, where one is given."""
    items = [item for value in values for item in (value if isinstance(value, list) else [value])]
    near = [pytest.approx(item, rel=tolerance) if tolerance and isinstance(item, float) else item for item in items]
    return near


if __name__ == "__main__":
    golden = {"regenerate": COMMAND} | {name: make() for name, (make, _) in WHAT.items()}
    GOLDEN.write_text(json.dumps(golden, indent=1) + "\n", encoding="utf-8")
