import math

import numpy as np
import pytest
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.level.table import LEVEL_METRICS


def short_episode(frames: int, *, failure: str | None = None) -> Episode:
    """Return a lift of so many frames to 200 mm, the robot 20 mm behind."""
    target = np.linspace(0.0, 0.2, frames)
    still = np.zeros(frames)
    return Episode(
        behaviour="smooth",
        subject="S1",
        trial="",
        seed=3,
        scores={
            **dict.fromkeys(LEVEL_METRICS, 0.0),
            "rmse_mm": 20.0,
            "max_tilt_deg": 1.4,
            "sparc": -1.5,
            "ldlj": -12.0,
            "human_force_n": 0.1,
            "robot_lag_ms": 100.0,
            "clipped": math.nan,
        },
        failure=failure,
        trace=Trace(
            human_end=target,
            robot_end=target - 0.02,
            human_velocity=still,
            human_force=still,
            robot_force=still,
            target=target,
            action=np.zeros((frames // 10, 1)),
            human_action=np.zeros((frames // 10, 10)),
            state=np.zeros((frames // 10, 16), dtype=np.uint8),
        ),
        step_times=(),
    )


@pytest.fixture
def episode() -> Episode:
    return short_episode(10)


@pytest.fixture
def dropped() -> Episode:
    return short_episode(10, failure="the table's end is out of the partner's reach")


@pytest.fixture
def long_episode() -> Episode:
    return short_episode(680)


@pytest.fixture
def empty_episode() -> Episode:
    return short_episode(0, failure="reset: ZeroDivisionError")


@pytest.fixture
def scenario() -> Scenario:
    return make_scenario("smooth")
