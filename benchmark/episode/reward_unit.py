"""The unit of rewards that are shares of the score."""

from typing import Final

UNIT: Final = 1e-4
"""Square error that costs 1 [m2]: a step with the ends 10 mm apart, about the error of two
humans."""
