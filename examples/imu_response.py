"""Elastic motion of the inertial measuring unit below and above the critical thrust.

The rigid-body motion is left out: without control a free vehicle drifts away at any thrust.
"""

import beal

vehicle = beal.catalog.tsto(split=0.6, rotational_stiffness=5000.0, shear_stiffness=5000.0)
for thrust in (90.0, 128.0):
    release = beal.Release(deflection=1e-3)
    motion = beal.response(vehicle, duration=2.0, thrust=thrust, initial=release, rigid_body=False)
    displacement, _ = motion.trajectory("imu")
    rate = beal.growth_rate(motion, "imu")
    print(f"P L^2/EI = {thrust:g}: largest deflection {abs(displacement).max():.2e}, growth rate {rate:.3f}")
