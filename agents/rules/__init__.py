"""Rules that the scorer reads as numbers of one lift, and the twin as arrays of many."""

from colift.agents.rules.functions import SCALARS, ArrayFunctions, N
from colift.agents.rules.series import NumberSeries, Series, at_time

__all__ = ["SCALARS", "ArrayFunctions", "N", "NumberSeries", "Series", "at_time"]
