"""Where integrals become matrices: bases, axial force, assembly."""

from beal.discretise.build import FORMULATIONS, Formulation, discretise
from beal.discretise.operators import Operators

__all__ = ["FORMULATIONS", "Formulation", "Operators", "discretise"]
