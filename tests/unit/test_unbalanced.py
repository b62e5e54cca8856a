"""Loads that correct a reduced problem: none are left where the reduced problem is the whole one."""

import numpy as np
import pytest
import scipy.linalg

from beal.discretisation.linked import linked
from beal.stability.imaginary_root import vanishing_root
from beal.stability.pencil import pencil
from beal.stability.refine import polish
from beal.stability.unbalanced import unbalanced
from beal.vehicle import Joint, Stage, Support, Thrust, Vehicle

UNIT = {"mass_per_length": 1.0, "bending_stiffness": 1.0}


def vehicle(internal, drags=(0.5, 0.5, 0.5), **parts):
    stages = [Stage(length=1 / 3, internal_damping=internal, external_damping=drag, **UNIT) for drag in drags]
    return Vehicle(stages=stages, joints=[Joint(rotational_stiffness=500.0), Joint()], **parts)


CLAMPED = {"support": Support(nose="clamped")}
CASES = {
    "a double root": (vehicle(0.0, (0.0,) * 3, **CLAMPED), "flutter", 20.0, 120.0),
    "a root on the imaginary axis": (vehicle(0.01, **CLAMPED), "flutter", 15.5, 47.0),
    "a vanishing damping": (vehicle(0.01, **CLAMPED), "vanishing", 15.4, 47.0),
    "a divergence": (vehicle(0.01, **CLAMPED, thrust=Thrust(tangency=0.2)), "divergence", 3.3, 0.0),
    "a divergence of rates": (vehicle(0.01, (0.1, 0.0, 0.5)), "divergence", 39.4, 0.0),
}


@pytest.mark.parametrize("case", CASES)
def test_a_critical_point_of_the_whole_vehicle_is_balanced(case):
    whole, kind, thrust, W = CASES[case]
    system = linked(whole, 5)
    admissible = scipy.linalg.null_space(system.B.toarray())
    M, static = (admissible.T @ matrix @ admissible for matrix in (system.M, system.static))
    kept = admissible @ scipy.linalg.eigh(M, static)[1][:, ::-1]  # rigid-body motions first
    full = pencil(system.projected(kept, system.rigid))
    kept = kept[:, kept.shape[1] - len(full.M) :]
    vanishing = kind == "vanishing"
    point = vanishing_root(full, thrust, W) if vanishing else polish(full, kind, thrust, W)
    assert point.converged
    left = list(unbalanced(system, kept, full, "flutter" if vanishing else kind, point, vanishing))
    assert len(left) == 2
    for loads in left:
        deflected = system.deflected(loads)
        size = np.sqrt(np.einsum("ij,ij->j", deflected, system.static @ deflected))  # in energy
        assert size.max() < 1e-11
