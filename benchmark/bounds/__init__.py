"""Bounds on any policy: one that knows the future, and one that learned all there is to see."""
