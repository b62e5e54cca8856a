"""Known answers: what the literature and exact computations say of the vehicles of the catalog, and what beal says."""

from beal.verification.run import verify

__all__ = ["verify"]
