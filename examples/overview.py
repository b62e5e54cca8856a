"""The picture of the README: frequencies over thrust, and the critical thrust over the joint's two springs.

python examples/overview.py [PICTURE.png]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import beal

vehicle = beal.catalog.tsto(split=0.8, rotational_stiffness=20.0, shear_stiffness=1000.0)
springs = {
    "joint[0].rotational_stiffness": np.geomspace(1, 1e4, 60),
    "joint[0].shear_stiffness": np.geomspace(1e2, 1e4, 60),
}
with beal.plot.style():
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
    found = beal.critical_thrust(vehicle)
    curve = beal.thrust_curve(vehicle, to=1.3 * found.critical_thrust, points=601, modes=3)
    beal.plot.thrust_curve(curve, left, critical=found)
    left.set_title("Frequencies of one vehicle over thrust")
    beal.plot.stability_map(beal.stability_map(vehicle, springs), right)
    right.set_title("Critical thrust over its joint's springs")
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "overview.png", dpi=130)
print(f"{found.kind} at P L^2/EI = {found.critical_thrust:.6f}, modes {found.modes}")
