"""Rules that the scorer reads as numbers of one lift, and the twin as arrays of many."""

from colift.agents.rules.functions import SCALARS, ArrayFunctions, N

__all__ = ["SCALARS", "ArrayFunctions", "N"]
