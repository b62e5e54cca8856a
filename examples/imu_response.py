"""Motion of the inertial measuring unit below and above the critical thrust."""

import beal
from beal.motion import Release, growth_rate

vehicle = beal.catalog.tsto(split=0.6, rotational_stiffness=5000.0, shear_stiffness=5000.0)
for thrust in (90.0, 128.0):
    motion = beal.response(vehicle, thrust=thrust, duration=4.0, initial=Release(amplitude=1e-3))
    rate = growth_rate(motion, "imu")
    print(f"P L^2/EI = {thrust:g}: largest deflection {abs(motion.displacement['imu']).max():.2e}, growth rate {rate:.3f}")
