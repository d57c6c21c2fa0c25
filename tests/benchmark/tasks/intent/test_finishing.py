"""A plan of poses that is not done at the end counts like frames that are missing."""

import contextlib

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.rules import SCALARS, Drawn
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.intent.task import Intent, Lowering


class Ended:
    """The end of a lift."""

    def __init__(self, **read):
        self.read = read

    def seen(self, name, age):
        assert age == 0
        return self.read[name]


def unfinished(time, human_end=0.0, robot_end=0.0):
    drawn = Drawn((), (), Lowering(500.0, 600.0), (), ())
    ended = Ended(time=time, human_end=human_end, robot_end=robot_end)
    return Intent().unfinished(SCALARS, drawn, ended)


def test_frames_that_the_person_has_not_come_to_are_unfinished():
    assert unfinished(450.0) == 150.0
    assert unfinished(590.5) == 9.5
    assert unfinished(600.0) == unfinished(640.0) == 0.0


def test_a_table_that_is_not_put_down_leaves_the_whole_lowering():
    assert unfinished(640.0, robot_end=0.051) == unfinished(640.0, human_end=0.2) == 100.0
    assert unfinished(640.0, 0.049, -0.049) == 0.0
    assert unfinished(550.0, robot_end=0.1) == 100.0
    assert unfinished(300.0, robot_end=0.1) == 300.0


@pytest.mark.parametrize(("policy", "done"), [("hold", False), ("touch_level", True)])
def test_each_unfinished_frame_counts_like_one_after_a_failure(policy, done):
    scenario = make_scenario("together", "S1", task="intent")
    with contextlib.closing(Lift(scenario)) as lift, PolicySpec(text=policy).agent() as robot:
        played = run_episode(lift, robot, 100_000)
        stop = lift.plan.strokes[-1][1]
    trace, scores = played.trace, played.scores
    assert (scores["finished"] == 1.0) is done
    left = stop * (1.0 - scores["finished"])
    near, far = trace.human_end - trace.target, trace.robot_end - trace.added["far_target"]
    squares = 1e6 * ((near**2).sum() + (far**2).sum()) / 2 + left * 250.0**2
    assert scores["rmse_mm"] == pytest.approx(np.sqrt(squares / (len(near) + left)))
