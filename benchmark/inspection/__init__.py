"""From a score to the reason: the worst lifts of a run, and where in a lift its error arises."""

from typing import Final

WORST: Final = 3
"""Number of lifts that are shown by default."""
