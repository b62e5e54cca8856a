"""Elastic motion of the inertial measuring unit below and above the critical thrust.

The rigid-body motion is left out: without control a free vehicle drifts away at any thrust.

python examples/imu_response.py [PICTURE.png]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import beal

vehicle = beal.catalog.tsto(split=0.6, rotational_stiffness=5000.0, shear_stiffness=5000.0)
with beal.plot.style():
    figure, panels = plt.subplots(2, figsize=(6.4, 4.8), sharex=True, layout="constrained")
    for thrust, ax in zip((90.0, 128.0), panels, strict=True):
        release = beal.Release(deflection=1e-3)
        motion = beal.response(vehicle, duration=2.0, thrust=thrust, initial=release, rigid_body=False)
        displacement, _ = motion.trajectory("imu")
        rate = beal.growth_rate(motion, "imu")
        print(f"P L^2/EI = {thrust:g}: largest deflection {abs(displacement).max():.2e}, growth rate {rate:.3f}")
        beal.plot.response(motion, ax, "imu").set_title(f"P L²/EI = {thrust:g}")
        ax.label_outer()
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "imu_response.png", dpi=130)
