"""Critical thrust in beal, which chooses its own discretisation and ignores the accuracy asked for."""

from sweep import EXPECTED, JOINT_AT, JOINT_STIFFNESS, report

from beal import Joint, Stage, Support, Vehicle, critical_thrust

SIZES = {(vehicle, accuracy): "own" for vehicle in EXPECTED for accuracy in (1e-3, 1e-6)}


def solve(vehicle: str, size: str, accuracy: float) -> tuple[float, str]:
    """Critical thrust P L^2/EI and its kind."""
    lengths = [JOINT_AT, 1 - JOINT_AT] if vehicle == "jointed" else [1.0]
    found = critical_thrust(
        Vehicle(
            units="nondimensional",
            stages=[Stage(length=length, mass_per_length=1.0, bending_stiffness=1.0) for length in lengths],
            joints=[Joint(rotational_stiffness=JOINT_STIFFNESS)] * (len(lengths) - 1),
            support=Support(nose="clamped" if vehicle == "beck" else "free"),
        )
    )
    return found.critical_thrust, found.kind


if __name__ == "__main__":
    report("beal", "beal", SIZES, solve)
