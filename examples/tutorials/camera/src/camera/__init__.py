"""Lifts with a slow camera."""

from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite


def camera_v1() -> Suite:
    """3 new people x 2 behaviours x 2 lifts, with motion capture that is 0.2 s old."""
    scenarios = tuple(
        make_scenario(behaviour, subject, latency=0.2)
        for behaviour in ("smooth", "changing_goal")
        for subject in ("draw-1", "draw-2", "draw-3")
    )
    return Suite(name="camera-v1", scenarios=scenarios, seeds=(0, 1))
