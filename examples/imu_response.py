"""Motion of the inertial measuring unit below and above the critical thrust."""

import beal

vehicle = beal.catalog.tsto(split=0.6, rotational_stiffness=5000.0, shear_stiffness=5000.0)
for thrust in (90.0, 128.0):
    motion = beal.response(vehicle, thrust=thrust, duration=4.0, initial=beal.Release(deflection=1e-3))
    displacement, _ = motion.trajectory("imu")
    rate = beal.growth_rate(motion, "imu")
    print(f"P L^2/EI = {thrust:g}: largest deflection {abs(displacement).max():.2e}, growth rate {rate:.3f}")
