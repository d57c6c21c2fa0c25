"""What sets each behaviour apart."""

import dataclasses

import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.humans import SUBJECTS, ChangingGoal, Jerky, Pause, Smooth

S2 = SUBJECTS["S2"]
SEEDS = range(100)


def event(plan, name):
    return dict(plan.events)[name]


def stroke_velocity(plan, number):
    start, stop = plan.strokes[number]
    return np.diff(plan.target[start - 1 : stop]) / FRAME


def ldlj(velocity):
    """Log dimensionless jerk, as the metric's authors compute it."""
    jerk = np.diff(velocity, 2) / FRAME**2
    duration = len(velocity) * FRAME
    return -np.log(duration**3 / np.abs(velocity).max() ** 2 * (jerk**2).sum() * FRAME)


def test_smooth_heights_and_durations_are_the_subjects():
    plans = [Smooth().plan(S2, seed) for seed in range(400)]
    goals = np.array([plan.goal for plan in plans])
    up = np.array([stop - start for (start, stop), _ in (plan.strokes for plan in plans)]) * FRAME
    down = np.array([stop - start for _, (start, stop) in (plan.strokes for plan in plans)]) * FRAME
    assert goals.mean() == pytest.approx(S2.amplitude, rel=0.02)
    assert np.ptp(goals) > 0.06
    assert up.mean() == pytest.approx(S2.duration, rel=0.01)
    assert np.abs(up / S2.duration - 1.0).max() <= S2.duration_spread + FRAME
    assert down.mean() / up.mean() == pytest.approx(S2.lowering_ratio, rel=0.02)


def test_smooth_is_skewed_early_up_and_late_down():
    plain = dataclasses.replace(S2, submovements=(0, 0))
    plan = Smooth().plan(plain, 1)
    up, down = stroke_velocity(plan, 0), stroke_velocity(plan, 1)
    assert np.argmax(up) / len(up) == pytest.approx(0.45, abs=0.01)
    assert np.argmin(down) / len(down) == pytest.approx(0.54, abs=0.01)


def test_submovements_make_a_stroke_less_smooth_but_not_jerky():
    def mean(count):
        subject = dataclasses.replace(S2, submovements=(count, count))
        return np.mean([ldlj(stroke_velocity(Smooth().plan(subject, s), 0)) for s in SEEDS])

    assert -7.0 < mean(3) < mean(0) - 0.3
    assert -5.6 < mean(0) < -5.0


def test_jerky_is_much_less_smooth_than_smooth():
    for name in SUBJECTS:
        smooth = [ldlj(stroke_velocity(Smooth().plan(SUBJECTS[name], s), 0)) for s in SEEDS]
        jerky = [ldlj(stroke_velocity(Jerky().plan(SUBJECTS[name], s), 0)) for s in SEEDS]
        assert min(smooth) > -7.5
        assert min(jerky) > -14.0
        assert -12.0 < np.mean(jerky) < -10.0
        assert max(jerky) < min(smooth)


def test_jerky_moves_at_two_to_three_hertz():
    for seed in SEEDS:
        for number in (0, 1):
            velocity = stroke_velocity(Jerky().plan(S2, seed), number)
            spectrum = np.abs(np.fft.rfft(velocity, 4096))
            frequency = np.fft.rfftfreq(4096, FRAME)
            fast = frequency > 1.4
            assert 1.8 < frequency[fast][np.argmax(spectrum[fast])] < 3.2


def test_jerky_reaches_the_same_goals_as_smooth():
    for seed in SEEDS:
        assert Jerky().plan(S2, seed).goal == pytest.approx(Smooth().plan(S2, seed).goal, abs=1e-9)


def test_pause_stands_still_for_its_time_half_way():
    for seed in SEEDS:
        plan = Pause().plan(S2, seed)
        start, stop = event(plan, "pause"), event(plan, "resume")
        stand = plan.target[start:stop]
        assert np.ptp(stand) == 0.0
        assert 0.8 <= len(stand) * FRAME <= 2.0
        assert 0.3 <= stand[0] / plan.goal <= 0.7
        assert len(plan.strokes) == 3
        assert any(end == start for _, end in plan.strokes)


def test_pause_is_mostly_on_the_way_up_and_at_times_on_the_way_down():
    plans = [Pause().plan(S2, seed) for seed in range(400)]
    down = np.mean([event(plan, "pause") > event(plan, "hold") for plan in plans])
    assert down == pytest.approx(0.25, abs=0.07)


def test_pause_brakes_without_going_back():
    for seed in SEEDS:
        plan = Pause().plan(S2, seed)
        for start, stop in plan.strokes:
            steps = np.diff(plan.target[start - 1 : stop])
            backwards = -np.sign(steps.sum()) * steps
            assert backwards[backwards > 0.0].sum() < 0.002


@pytest.mark.parametrize("change", ["reverse", "undershoot", "overshoot"])
def test_a_changed_goal_is_where_it_should_be(change):
    behaviour = ChangingGoal(changes=(change,))
    for seed in SEEDS:
        plan = behaviour.plan(S2, seed)
        switch, replan, hold = (event(plan, name) for name in (change, "replan", "hold"))
        assert 0.09 < (replan - switch) * FRAME < 0.21
        held = plan.target[hold]
        first = Smooth().plan(S2, seed).goal
        if change == "overshoot":
            assert held == pytest.approx(plan.goal, abs=2e-3)
            assert held == pytest.approx(first, abs=1e-9)
        elif change == "undershoot":
            assert 0.4 - 1e-9 <= held / first <= 0.8 + 1e-9
        else:
            assert held < plan.target[replan]
            assert plan.target[switch] >= 0.079
            assert 0.2 - 1e-9 <= (plan.target[replan - 1] - held) / first <= 0.6 + 1e-9 or (
                held == pytest.approx(0.03)
            )


def test_all_changes_are_as_likely():
    names = [ChangingGoal().plan(S2, seed).events[2][0] for seed in range(600)]
    for change in ("reverse", "undershoot", "overshoot"):
        assert names.count(change) / len(names) == pytest.approx(1 / 3, abs=0.06)


def test_the_movement_before_a_change_does_not_foretell_it():
    behaviours = [ChangingGoal(changes=("reverse",)), ChangingGoal(changes=("undershoot",))]
    for seed in SEEDS:
        reverse, undershoot = (behaviour.plan(S2, seed) for behaviour in behaviours)
        change = event(undershoot, "undershoot")
        assert np.array_equal(reverse.target[:change], undershoot.target[:change])
