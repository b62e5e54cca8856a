"""Build a vehicle in Python, find its critical thrust, see what the joint costs.

python examples/critical_thrust.py [PICTURE.png]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

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

stiffness = np.geomspace(1.0, 1000.0, 121)
line = beal.stability_map(vehicle, {"joint[0].rotational_stiffness": stiffness})
with beal.plot.style():
    figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    for kind, name, mark in ((2, "divergence", "D"), (1, "flutter", "o")):
        ax.semilogx(stiffness, line.critical_thrust.where(line.kind == kind), mark, markersize=3, label=name)
    ax.set_xlabel("rotational stiffness $k_r L/EI$")
    ax.set_ylabel("critical thrust $P L^2/EI$")
    ax.legend()
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "critical_thrust.png", dpi=130)
