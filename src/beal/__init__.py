"""beal: stability of flexible launch vehicles under thrust."""
