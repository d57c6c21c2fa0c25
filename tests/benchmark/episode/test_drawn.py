import dataclasses

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.episode.drawn import DrawnSeries, drawn_heights, drawn_hurdles
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.trace import Trace
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario

BAR = DrawnSeries(name="bar", label="bar", where="robot", stay=0.05)


def trace_of(bar: np.ndarray, near: float = 0.1, far: float = 0.1) -> Trace:
    """Return a lift whose ends rest at two heights, with a target of 0.1 m and a series."""
    frames = len(bar)
    still = np.zeros(frames)
    return Trace(
        human_end=np.full(frames, near),
        robot_end=np.full(frames, far),
        human_velocity=still,
        human_force=still,
        robot_force=still,
        target=np.full(frames, 0.1),
        action=np.zeros((frames // 10, 1)),
        human_action=np.zeros((frames // 10, 10)),
        state=np.zeros((frames // 10, 16), np.uint8),
        added={"bar": bar},
    )


def test_a_hurdle_is_open_where_its_series_leaves_the_intention() -> None:
    bar = np.full(100, 0.1)
    bar[20:40], bar[60:70] = 0.15, 0.05
    found = drawn_hurdles((BAR,), trace_of(bar))
    assert [(each.start, each.stop, each.height) for each in found] == [
        (20, 40, 0.15),
        (60, 70, 0.05),
    ]
    assert [frame for frame in range(100) if found[0].open_at(frame)] == [*range(20, 40)]


def test_windows_that_touch_are_two_hurdles() -> None:
    bar = np.full(60, 0.1)
    bar[:20], bar[20:60] = 0.15, 0.12
    found = drawn_hurdles((BAR,), trace_of(bar))
    assert [(each.start, each.stop) for each in found] == [(0, 20), (20, 60)]


def test_both_ends_count_in_the_nearest_stay() -> None:
    bar = np.full(60, 0.1)
    bar[10:50] = 0.15
    trace = trace_of(bar, near=0.11, far=0.12)
    robot_end = trace.robot_end.copy()
    robot_end[30:36] = 0.15
    (found,) = drawn_hurdles((BAR,), dataclasses.replace(trace, robot_end=robot_end))
    assert found.stay == 5
    assert found.nearest in (30, 31)
    assert found.missed == pytest.approx(np.sqrt(0.04**2 / 2))


def test_a_window_that_is_cut_off_is_not_reached() -> None:
    bar = np.full(30, 0.1)
    bar[27:] = 0.15
    (found,) = drawn_hurdles((BAR,), trace_of(bar))
    assert (found.nearest, found.missed) == (None, None)


def test_a_lift_without_frames_has_no_hurdles() -> None:
    assert drawn_hurdles((BAR,), trace_of(np.zeros(0))) == ()


def test_a_hurdle_is_no_height_that_is_there_all_the_time() -> None:
    height = DrawnSeries(name="far", label="far")
    place = DrawnSeries(name="ball", label="ball", where="place")
    assert drawn_heights((BAR, height, place)) == (height,)


@pytest.mark.parametrize("behaviour", ["ahead", "own_hurdle", "other_hurdle", "no_hurdle"])
def test_what_pictures_say_is_missed_is_what_the_scores_say(behaviour: str) -> None:
    scenario = make_scenario(behaviour, "S4", task="agree")
    episode = next(play(PolicySpec(text="agree_admittance"), scenario, (1,)))
    found = drawn_hurdles(drawn_series(scenario.task.metrics), episode.trace)
    missed = {each.where: each.missed for each in found}
    for end in ("human", "robot"):
        score = episode.scores[f"{end}_hurdle_mm"]
        assert (end in missed) is not np.isnan(score)
        if end in missed:
            assert 1000 * missed[end] == pytest.approx(score, rel=1e-9)
