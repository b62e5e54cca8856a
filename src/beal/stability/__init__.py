"""Operators -> spectrum, tracked curves, critical thrust and its verifier."""
