"""What the user describes: the parts of a vehicle, the vehicle, its file format and a catalog."""

from beal.vehicle import catalog
from beal.vehicle.control import Actuator, Control, Engine, Filter, Gain
from beal.vehicle.file import dumps, loads
from beal.vehicle.parts import (
    AxialLoad,
    Damping,
    DistributedThrust,
    ElasticEnd,
    Force,
    Joint,
    PointMass,
    Sensor,
    Stage,
    Support,
    Thrust,
)
from beal.vehicle.paths import value_at, with_values
from beal.vehicle.signals import Chirp, Gust, Noise, Pulse, Sine, Step, Table
from beal.vehicle.tanks import Tank
from beal.vehicle.timeline import Timeline
from beal.vehicle.vehicle import Scales, Vehicle

__all__ = [
    "Actuator",
    "AxialLoad",
    "Chirp",
    "Control",
    "Damping",
    "DistributedThrust",
    "ElasticEnd",
    "Engine",
    "Filter",
    "Force",
    "Gain",
    "Gust",
    "Joint",
    "Noise",
    "PointMass",
    "Pulse",
    "Scales",
    "Sensor",
    "Sine",
    "Stage",
    "Step",
    "Support",
    "Table",
    "Tank",
    "Thrust",
    "Timeline",
    "Vehicle",
    "catalog",
    "dumps",
    "loads",
    "value_at",
    "with_values",
]
