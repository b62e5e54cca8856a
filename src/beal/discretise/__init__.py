"""Where integrals become matrices: bases, axial force, assembly."""
