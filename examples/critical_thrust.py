"""Build a vehicle in Python, find its critical thrust, see what the joint costs."""

import beal

beam = beal.Stage(length=0.5, mass_per_length=1.0, bending_stiffness=1.0)
for k_r in (float("inf"), 100.0, 20.0, 10.0, 1.0):
    vehicle = beal.Vehicle(
        units="nondimensional",
        stages=[beam, beam],
        joints=[beal.Joint(rotational_stiffness=k_r)],
    )
    found = beal.critical_thrust(vehicle)
    print(f"k_r L/EI = {k_r:5g}: {found.kind} at P L^2/EI = {found.critical_thrust:.6f}, modes {found.modes}")
