"""Limits of a real robot, which does not wait, for a policy and for the motion capture."""

from typing import Final

POLICY_SHARE: Final = 0.6
"""Fraction of the control period that the policy may take; a later answer is discarded. The rest is
for reading the robot and for the command."""

LOWEST_RATE: Final = 50.0
"""Lowest usable rate of the motion capture [1/s]; the paper's is 100 Hz."""
