"""Where integrals become matrices: bases, axial force, assembly."""

from beal.discretisation.build import FORMULATIONS, Formulation, discretise
from beal.discretisation.operators import Operators

__all__ = ["FORMULATIONS", "Formulation", "Operators", "discretise"]
