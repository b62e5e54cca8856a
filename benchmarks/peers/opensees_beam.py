"""Critical thrust in OpenSeesPy, with the eigenvalues found in SciPy.

OpenSees has no follower load on beams, so its entry goes into the exported tangent by hand, which its own `eigen` does
not see. The geometric stiffness is that of each element's chord, so the error falls only with the square of the
element's length: 1e-6 would take more than a thousand elements.
"""

import numpy as np
import openseespy.opensees as ops
import scipy.linalg
from sweep import JOINT_AT, JOINT_STIFFNESS, first_instability, report

ELEMENTS = {("beck", 1e-3): 44, ("free-free", 1e-3): 80, ("jointed", 1e-3): 40}


def analysis_of(kind: str) -> None:
    """A linear analysis with a dense matrix that can be exported."""
    ops.system("FullGeneral")
    ops.numberer("Plain")
    ops.constraints("Transformation")
    ops.algorithm("Linear")
    ops.analysis(kind, "-noWarnings")


def exported(mass: float, stiffness: float) -> np.ndarray:
    """The mass or the tangent stiffness matrix."""
    ops.integrator("GimmeMCK", mass, 0.0, stiffness)
    ops.analyze(1, 0.0)
    return np.reshape(ops.printA("-ret"), 2 * [ops.systemSize()])


def roots(thrust: float, vehicle: str, elements: int) -> np.ndarray:
    """Squared frequencies of the beam under its thrust."""
    clamped = vehicle == "beck"
    joint = round(JOINT_AT * elements) if vehicle == "jointed" else None
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for i in range(elements + 1):
        ops.node(i, i / elements, 0.0)
    ops.fix(0, 1, int(clamped), int(clamped))
    if joint is not None:
        hinge = elements + 1  # node of the aft part at the joint
        ops.node(hinge, JOINT_AT, 0.0)
        ops.equalDOF(joint, hinge, 1, 2)
        ops.uniaxialMaterial("Elastic", 1, JOINT_STIFFNESS)
        ops.element("zeroLength", hinge, joint, hinge, "-mat", 1, "-dir", 6)
    ops.geomTransf("PDelta", 1)
    for i in range(elements):
        fore = hinge if i == joint else i
        ops.element("elasticBeamColumn", i, fore, i + 1, 1.0, 1e6, 1e-6, 1, "-mass", 1.0, "-cMass")
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(elements, -thrust, 0.0, 0.0)
    if not clamped:  # inertia of the vehicle, which accelerates
        for i in range(elements + 1):
            ops.load(i, thrust / elements / (1 if 0 < i < elements else 2), 0.0, 0.0)
    ops.integrator("LoadControl", 1.0)
    analysis_of("Static")
    ops.analyze(1)
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    ops.integrator("GimmeMCK", 1.0, 0.0, 0.0)
    analysis_of("Transient")
    M, K = exported(1.0, 0.0), exported(0.0, 1.0)
    _, deflection, slope = ops.nodeDOFs(elements)
    K[deflection, slope] += thrust
    numbers = {number for node in range(elements + 1) for number in ops.nodeDOFs(node)[1:] if number >= 0}
    if joint is not None:
        numbers.add(ops.nodeDOFs(hinge)[0])  # a constrained node lists its own rotation first
    lateral = np.ix_(*2 * [sorted(numbers)])
    return scipy.linalg.eigvals(K[lateral], M[lateral])


def solve(vehicle: str, elements: int, accuracy: float) -> tuple[float, str]:
    """Critical thrust P L^2/EI and its kind."""
    return first_instability(lambda P: roots(P, vehicle, elements), 0 if vehicle == "beck" else 2, accuracy / 10)


if __name__ == "__main__":
    report("OpenSeesPy + SciPy", "openseespy", ELEMENTS, solve)
