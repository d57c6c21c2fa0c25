"""Bounds on any policy: one that knows the future, and one learned from all observations."""
