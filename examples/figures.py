"""One page on a vehicle: what it looks like, how it moves under thrust, and where its roots go.

python examples/figures.py [PICTURE.png]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import beal

soft = beal.Joint(name="interstage", rotational_stiffness=1000.0, shear_stiffness=1000.0, rotational_damping=0.5)
vehicle = beal.Vehicle(
    units="nondimensional",
    stages=[
        beal.Stage(name="upper stage", length=0.6, mass_per_length=1.0, bending_stiffness=0.9, internal_damping=1e-3),
        beal.Stage(name="booster", length=0.4, mass_per_length=1.0, bending_stiffness=1.0, internal_damping=1e-3),
    ],
    joints=[soft],
    point_masses=[beal.PointMass(name="payload", station=0.1, mass=0.02)],
    sensors=[beal.Sensor(name="imu", station=0.3)],
)
found = beal.critical_thrust(vehicle)
operators = beal.discretise(vehicle)
modes = beal.spectrum(operators, thrust=1.3 * found.critical_thrust, count=3)
curve = beal.thrust_curve(vehicle, to=1.4 * found.critical_thrust, modes=3)
with beal.plot.style():
    figure = plt.figure(figsize=(10.0, 4.6), layout="constrained")
    panels = figure.subplot_mosaic(
        [["vehicle", "roots"], ["modes", "roots"]], width_ratios=(1.4, 1.0), height_ratios=(1, 2)
    )
    beal.plot.vehicle(vehicle, panels["vehicle"])
    beal.plot.mode_shapes(modes, operators, panels["modes"])
    beal.plot.root_locus(curve, panels["roots"], critical=found)
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "figures.png", dpi=130)
print(f"{found.kind} of mode {found.modes[0]} at P L^2/EI = {found.critical_thrust:.5f}")
