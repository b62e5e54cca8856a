"""Vehicles from the literature, non-dimensional: EI = m = L = 1 unless an entry says otherwise."""

from beal.vehicle.catalog.beck import (
    beck,
    beck_cracked,
    beck_damped,
    beck_on_foundation,
    beck_on_springs,
    beck_subtangential,
    beck_tapered,
)
from beal.vehicle.catalog.columns import euler, greenhill, hauger, leipholz, pflueger, reut
from beal.vehicle.catalog.launcher import generic_small_launcher
from beal.vehicle.catalog.missiles import beal, beal_controlled, mladenov_sugiyama, park_mote, tsto
from beal.vehicle.catalog.pendulum import ziegler
from beal.vehicle.catalog.timoshenko import beal_timoshenko, beck_timoshenko

__all__ = [
    "beal",
    "beal_controlled",
    "beal_timoshenko",
    "beck",
    "beck_cracked",
    "beck_damped",
    "beck_on_foundation",
    "beck_on_springs",
    "beck_subtangential",
    "beck_tapered",
    "beck_timoshenko",
    "euler",
    "generic_small_launcher",
    "greenhill",
    "hauger",
    "leipholz",
    "mladenov_sugiyama",
    "park_mote",
    "pflueger",
    "reut",
    "tsto",
    "ziegler",
]
