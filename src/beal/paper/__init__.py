"""Irani & Kavianipour (2009), regenerated: figures, claims tested one by one, and what is wrong in print."""
