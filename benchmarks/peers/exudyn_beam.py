"""Critical thrust in Exudyn: planar ANCF elements with a body-fixed force at the tail.

The documented `ComputeODE2Eigenvalues` leaves the derivative of the loads out, hence the follower force: by it Beck's
column is unstable from Euler's load, 2.47. The solver below it must be called with `computeLoadsJacobian=1`.
The axial force of a free-free beam comes from its weight in the frame that accelerates with it.
"""

import exudyn
import numpy as np
import scipy.linalg
from exudyn.beams import GenerateBeamElementsAlongLine
from exudyn.itemInterface import (
    CoordinateConstraint,
    CoordinateSpringDamper,
    LoadForceVector,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    ObjectANCFCable2D,
)
from sweep import JOINT_AT, JOINT_STIFFNESS, first_instability, report

ELEMENTS = {
    ("beck", 1e-3): 5,
    ("beck", 1e-6): 36,
    ("free-free", 1e-3): 10,
    ("free-free", 1e-6): 56,
    ("jointed", 1e-3): 10,  # with many more, rounding splits the rigid-body pair so far that it hides divergence
}
AXIAL_STIFFNESS = {1e-3: 1e6, 1e-6: 1e8}  # the beam shortens, which raises the critical load by about P/EA


def joined(system: exudyn.MainSystem, fore: int, aft: int) -> None:
    """Connect two nodes by a rotational spring; their coordinates are x, y, x', y'."""
    for coordinate in range(2):
        ends = [system.AddMarker(MarkerNodeCoordinate(nodeNumber=n, coordinate=coordinate)) for n in (fore, aft)]
        system.AddObject(CoordinateConstraint(markerNumbers=ends))
    slopes = [system.AddMarker(MarkerNodeCoordinate(nodeNumber=n, coordinate=3)) for n in (fore, aft)]
    system.AddObject(CoordinateSpringDamper(markerNumbers=slopes, stiffness=JOINT_STIFFNESS))


def roots(thrust: float, vehicle: str, elements: int, axial_stiffness: float) -> np.ndarray:
    """Squared frequencies about the beam at rest under its thrust."""
    clamped = vehicle == "beck"
    ends = [0, JOINT_AT, 1] if vehicle == "jointed" else [0, 1]
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    cable = ObjectANCFCable2D(physicsMassPerLength=1, physicsBendingStiffness=1, physicsAxialStiffness=axial_stiffness)
    beams = [
        GenerateBeamElementsAlongLine(
            system,
            [fore, 0, 0],
            [aft, 0, 0],
            round((aft - fore) * elements),
            cable,
            gravity=[0 if clamped else thrust, 0, 0],
            groundConstraintsStart=None if fore else [1, clamped, 0, clamped],
        )
        for fore, aft in zip(ends, ends[1:], strict=False)
    ]
    if len(beams) == 2:
        joined(system, beams[0]["nodes"][-1], beams[1]["nodes"][0])
    tail = system.AddMarker(MarkerBodyRigid(bodyNumber=beams[-1]["elements"][-1], localPosition=[1 / elements, 0, 0]))
    system.AddLoad(LoadForceVector(markerNumber=tail, loadVector=[-thrust, 0, 0], bodyFixed=True))
    system.Assemble()

    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.staticSolver.verboseMode = 0
    settings.staticSolver.computeLoadsJacobian = True
    settings.staticSolver.newton.absoluteTolerance = 1e-4  # axial_stiffness times rounding
    settings.staticSolver.stabilizerODE2term = 0 if clamped else 1e-3  # a free beam floats
    system.SolveStatic(settings)
    state = system.systemData.GetSystemState()
    system.systemData.SetSystemState(state, configuration=exudyn.ConfigurationType.Initial)

    solver = exudyn.MainSolverStatic()
    solver.InitializeSolver(system, settings)
    n = solver.GetODE2size()
    solver.ComputeMassMatrix(system)
    solver.ComputeJacobianODE2RHS(
        system, scalarFactor_ODE2=-1, scalarFactor_ODE2_t=0, scalarFactor_ODE1=0, computeLoadsJacobian=1
    )
    solver.ComputeJacobianAE(system, scalarFactor_ODE2=1, scalarFactor_ODE2_t=0, scalarFactor_ODE1=0)
    M, jacobian = solver.GetSystemMassMatrix(), solver.GetSystemJacobian()
    solver.FinalizeSolver(system, settings)
    free = scipy.linalg.null_space(jacobian[n:, :n])
    return scipy.linalg.eigvals(free.T @ jacobian[:n, :n] @ free, free.T @ M @ free)


def solve(vehicle: str, elements: int, accuracy: float) -> tuple[float, str]:
    """Critical thrust P L^2/EI and its kind."""
    rigid = 0 if vehicle == "beck" else 2
    return first_instability(lambda P: roots(P, vehicle, elements, AXIAL_STIFFNESS[accuracy]), rigid, accuracy / 10)


if __name__ == "__main__":
    report("Exudyn", "exudyn", ELEMENTS, solve)
