"""Critical thrust in scikit-fem and SciPy: the forms of the beam, the follower entry and the joint by hand."""

import numpy as np
import scipy.linalg
import skfem
from skfem.helpers import dd, ddot, dot, grad
from sweep import JOINT_AT, JOINT_STIFFNESS, first_instability, report

ELEMENTS = {
    ("beck", 1e-3): 5,
    ("beck", 1e-6): 30,
    ("free-free", 1e-3): 10,
    ("free-free", 1e-6): 54,
    ("jointed", 1e-3): 10,
    ("jointed", 1e-6): 30,
}


@skfem.BilinearForm
def bending(u, v, w):
    return ddot(dd(u), dd(v))


@skfem.BilinearForm
def axial(u, v, w):
    return (1 if w["clamped"] else w.x[0]) * dot(grad(u), grad(v))


@skfem.BilinearForm
def inertia(u, v, w):
    return u * v


def solve(vehicle: str, elements: int, accuracy: float) -> tuple[float, str]:
    """Critical thrust P L^2/EI and its kind."""
    clamped = vehicle == "beck"
    places = np.linspace(0, 1, elements + 1)
    joint = round(JOINT_AT * elements)
    parts = [places[: joint + 1], places[joint:]] if vehicle == "jointed" else [places]
    bases = [skfem.Basis(skfem.MeshLine(part), skfem.ElementLineHermite()) for part in parts]
    M, K, G = (
        scipy.linalg.block_diag(*[form.assemble(basis, **values).toarray() for basis in bases])
        for form, values in ((inertia, {}), (bending, {}), (axial, {"clamped": clamped}))
    )
    deflection, slope = bases[-1].nodal_dofs[:, -1] + len(K) - bases[-1].N
    K1 = -G
    K1[deflection, slope] += 1.0
    if clamped:
        kept = np.setdiff1d(np.arange(len(K)), bases[0].nodal_dofs[:, 0])
        free = np.eye(len(K))[:, kept]
    elif len(bases) == 2:
        (y1, slope1), (y2, slope2) = bases[0].nodal_dofs[:, -1], bases[1].nodal_dofs[:, 0] + bases[0].N
        K[np.ix_([slope1, slope2], [slope1, slope2])] += JOINT_STIFFNESS * np.array([[1, -1], [-1, 1]])
        free = np.eye(len(K))
        free[y2, y1] = 1.0
        free = np.delete(free, y2, axis=1)
    else:
        free = np.eye(len(K))
    M, K, K1 = (free.T @ matrix @ free for matrix in (M, K, K1))
    return first_instability(lambda P: scipy.linalg.eigvals(K + P * K1, M), 0 if clamped else 2, accuracy / 10)


if __name__ == "__main__":
    report("scikit-fem + SciPy", "scikit-fem", ELEMENTS, solve)
