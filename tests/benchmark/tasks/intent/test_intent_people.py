"""Plans of poses, the pace of a person, and manners."""

import math

import numpy as np
import pytest
from colift.agents.humans import SUBJECTS, Subject
from colift.agents.rules import SCALARS, NumberSeries, at_time
from colift.benchmark.tasks.intent.manner import MANNERS, leading_manner
from colift.benchmark.tasks.intent.pace import CATCHING_UP
from colift.benchmark.tasks.intent.person import Leads
from colift.benchmark.tasks.intent.poses import (
    HIGHEST,
    LOWEST,
    SHARES,
    STEEPEST,
    Counter,
    Pivot,
    Switching,
    Together,
)
from colift.benchmark.tasks.intent.task import Pose

from ..past import Past, Walking, drawn_of

S1 = SUBJECTS["S1"]


@pytest.mark.parametrize(
    ("behaviour", "share"), [(Together(), 1.0), (Pivot(), 0.0), (Counter(), -1.0)]
)
def test_the_far_end_moves_by_its_share_between_lifting_and_lowering(behaviour, share):
    for seed in range(20):
        plan = behaviour.plan(S1, seed)
        first, last = plan.strokes[0][1], plan.strokes[-1][0]
        near, far = np.diff(plan.target[first:last]), np.diff(plan.far[first:last])
        assert np.allclose(far, share * near, atol=1e-9)


def test_the_table_is_level_at_both_ends_of_every_plan_and_poses_are_within_reach():
    for seed in range(60):
        for behaviour in (Pivot(), Counter(), Switching()):
            plan = behaviour.plan(S1, seed)
            assert plan.far[0] == plan.far[-1] == 0.0
            assert len(plan.far) == len(plan.target)
            assert plan.far.max() <= HIGHEST + 1e-9
            held = slice(plan.strokes[0][1], plan.strokes[-1][0])
            assert plan.far[held].min() >= LOWEST - 1e-9
            assert np.abs(plan.far - plan.target).max() <= STEEPEST + 1e-9


def test_switching_has_two_intents_without_a_rest_between_them():
    plan = Switching().plan(S1, 3)
    names = [name for name, _ in plan.events if name in SHARES]
    assert len(names) == 8
    assert all(one != other for one, other in zip(names[::2], names[1::2], strict=True))
    assert len(plan.strokes) == 6


def planned_at(series, time):
    return at_time(SCALARS, NumberSeries.of(series), time)


def test_a_person_waits_for_a_far_end_that_is_off_and_catches_up_later():
    far = np.linspace(0.0, 0.2, 400)
    drawn = drawn_of(np.zeros(400), MANNERS["S1"], series=Pose(np.zeros(400), far))
    patience, delay = MANNERS["S1"].patience, round(S1.visual_delay / 0.01)
    walking, history = Walking(Leads(), drawn), [0.0] * 50
    view = Past(visual=delay, read={"robot_end": history, "far": [0.0] * 50})
    for _ in range(10):  # The far end follows perfectly, then stands still.
        walking.step(view)
        history += view.read["far"][-10:]
    assert walking.memory.time == 100
    for _ in range(90):
        before = walking.memory.time
        walking.step(view)
        history += [history[-1]] * 10
    assert walking.memory.time - before < 0.01
    assert view.read["far"][-1] - history[-1] == pytest.approx(2 * patience, abs=0.01)
    waited = walking.memory.time
    history += [planned_at(far, waited)] * (delay + 1)
    walking.step(view)
    assert walking.memory.time - waited == pytest.approx(10 * CATCHING_UP)


def test_a_plan_s_heights_between_frames_are_interpolated():
    series = np.array([1.0, 2.0, 4.0])
    assert [planned_at(series, time) for time in (0.0, 0.5, 1.0, 2.5, 3.0, 9.0)] == [
        0.0,
        0.5,
        1.0,
        3.0,
        4.0,
        4.0,
    ]


def test_manners_follow_from_the_name_alone_and_new_people_differ():
    drawn = [leading_manner(Subject.draw(seed)) for seed in range(20)]
    assert len({manner.wrist for manner in drawn}) == 20
    assert drawn[3] == leading_manner(Subject.draw(3))
    assert leading_manner(S1) == MANNERS["S1"]
    assert all(-0.4 <= manner.wrist <= 1.2 and math.isfinite(manner.lead) for manner in drawn)
