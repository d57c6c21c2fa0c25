"""The latency report of a session: the timing of the real-time loop."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
from colift.agents.hardware.plausibility import disordered
from colift.agents.hardware.stops import HoldReason
from colift.agents.hardware.trial_log import TrialLog


def timing_report(logs: Sequence[TrialLog]) -> dict[str, Any]:
    """Return percentiles over all steps of some trials, and counts.

    ================= ============================================================================
    sensing_age_ms    age of the newest motion-capture frame when a step begins
    lowest_rate_hz    fewest frames of any second
    misdated          frames whose time stamps were ahead of the clock, or no numbers
    disordered        frames that were not newer than one before them: repeated, overtaken, or
                      stamped by a clock that went back
    state_ms          time to read the robot
    policy_ms         time of the policy, where it answered
    command_ms        time to give a command, where one was given
    period_error_ms   distance of the time between two steps from the control period
    late_steps        periods that were skipped because the loop came too late
    held              steps without a command, by their reason; skipped periods count as well
    ================= ============================================================================
    """
    steps = [step for log in logs for step in log.steps]
    acted = [step for step in steps if not np.isnan(step.action)]
    late = sum(log.late_steps for log in logs)
    skipped = +Counter({HoldReason.SKIPPED.value: late})
    errors = [
        abs(error)
        for log in logs
        for error in np.diff([step.time for step in log.steps]) - log.period
    ]
    return {
        "steps": len(steps),
        "sensing_age_ms": percentiles([step.sensing_age for step in steps]),
        "lowest_rate_hz": min((s.rate for s in steps if np.isfinite(s.rate)), default=None),
        "misdated": sum(log.misdated for log in logs),
        "state_ms": percentiles([step.state_time for step in steps]),
        "policy_ms": percentiles([step.policy_time for step in acted]),
        "command_ms": percentiles([step.command_time for step in acted]),
        "period_error_ms": percentiles(errors),
        "late_steps": late,
        "disordered": sum(disordered(log.samples) for log in logs),
        "held": dict(+Counter([step.hold for step in steps if step.hold]) + skipped),
    }


def percentiles(times: Sequence[float]) -> dict[str, float | None]:
    """Return median, 99th percentile and largest of some times, from s to ms."""
    finite = [time for time in times if np.isfinite(time)]
    if not finite:
        return {"p50": None, "p99": None, "max": None}
    p50, p99, largest = 1000 * np.percentile(finite, [50, 99, 100])
    return {"p50": float(p50), "p99": float(p99), "max": float(largest)}
