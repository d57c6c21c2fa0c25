"""Verification of a result bundle: whether its scores follow from its actions.

Every episode is simulated again, from its seed and the logged actions alone, and the scripted human
must act as logged. That proves that the scores follow from the actions of the robot's end. It does
not prove who produced the actions: only a board's own run does.
"""

from colift.benchmark.verification.verdict import (
    ACTIONS_FROM_LOG,
    PROVES,
    UNPROVEN,
    Finding,
    Verdict,
)
from colift.benchmark.verification.verify import verify

__all__ = ["ACTIONS_FROM_LOG", "PROVES", "UNPROVEN", "Finding", "Verdict", "verify"]
