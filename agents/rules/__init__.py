"""Rules that the scorer reads as numbers of one lift, and the twin as arrays of many."""

from colift.agents.rules.functions import SCALARS, ArrayFunctions, N
from colift.agents.rules.series import NumberSeries, Series, at_time
from colift.agents.rules.view import Drawn, View

__all__ = ["SCALARS", "ArrayFunctions", "Drawn", "N", "NumberSeries", "Series", "View", "at_time"]
