from importlib.resources import files

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.copy import Copy
from colift.agents.policies.hold import Hold
from colift.agents.policies.proportional import Proportional, ProportionalParameters
from colift.base.errors import InputError
from colift.benchmark.episode import sensing
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite

TEMPLATE = files("colift.agents.submissions") / "template" / "policy.py"
VIEWS = np.random.default_rng(0).uniform(-0.1, 0.2, (50, 5))


def with_gain(gain):
    policy = Proportional(parameters=ProportionalParameters(gain=gain))
    policy.reset(0)
    return policy


def follow(policy, heights, age):
    """Return the heights of a hand that does at once as told, the human being seen ``age`` late."""
    hand = [0.0]
    for k in range(len(heights)):
        seen = heights[max(k - age, 0)]
        hand.append(hand[-1] + policy.act(np.array([seen, 0.3, hand[-1], -0.3, 0.1 * k]))[0])
    return np.array(hand[:-1])


@pytest.fixture
def push(monkeypatch):
    """Push the hand by 1 cm beside a human who stays, without noise; return what it does in 3 s."""
    monkeypatch.setattr(sensing, "MOCAP_NOISE", 0.0)

    def actions(gain, control_period, subject):
        made = Lift(make_scenario("smooth", subject, control_period=control_period))
        made.reset(5000)
        policy, still = with_gain(gain), np.zeros(made.frames_per_step)
        made.step(still, np.array([0.01]))
        done = []
        for _ in range(round(3.0 / control_period)):
            done.append(policy.act(made.partner_observation())[0])
            made.step(still, np.array(done[-1:]))
        return np.abs(done)

    return actions


@pytest.mark.parametrize("gain", [0.4, 1.0, 1.8])
def test_the_action_is_the_gain_times_what_is_seen_less_what_is_felt(gain):
    policy = with_gain(gain)
    for view in VIEWS:
        assert policy.act(view) == pytest.approx([gain * (view[0] - view[2])], abs=1e-15)


@pytest.mark.parametrize("gain", [0.4, 1.0, 1.8])
def test_a_step_is_made_up_for_geometrically(gain):
    hand = follow(with_gain(gain), np.full(20, 0.1), age=1)
    assert 0.1 - hand == pytest.approx(0.1 * (1 - gain) ** np.arange(20), abs=1e-15)


@pytest.mark.parametrize("gain", [0.4, 1.0, 1.8])
@pytest.mark.parametrize("age", [0, 1, 3])
def test_a_steady_human_is_followed_by_the_latency_and_a_period_over_the_gain(gain, age):
    heights = 0.01 * np.arange(120)
    behind = heights - follow(with_gain(gain), heights, age)
    assert behind[-1] == pytest.approx(0.01 * (age + 1 / gain), abs=1e-12)


@pytest.mark.parametrize("control_period", [0.02, 0.05, 0.1])
@pytest.mark.parametrize("subject", ["S1", "S3", "S5"])
def test_after_a_push_the_hand_comes_to_rest(push, control_period, subject):
    actions = push(ProportionalParameters().gain, control_period, subject)
    assert actions[-10:].max() < 0.05 * actions[:10].max()


@pytest.mark.parametrize("subject", ["S1", "S3", "S5"])
def test_at_little_more_than_twice_the_gain_it_never_does(push, subject):
    actions = push(2.1 * ProportionalParameters().gain, 0.1, subject)
    assert actions[-10:].min() > 0.5 * actions[:10].max()


def test_makes_up_for_the_sag_of_the_own_hand():
    """In the mean of lifts: what is left of a sag of half a millimetre is near the noise."""
    made = Lift(make_scenario("smooth", "S2"))
    sag = {
        policy: np.mean(
            [
                (trace.human_end - trace.robot_end)[-10:].mean()
                for trace in (run_episode(made, policy(), seed).trace for seed in range(5000, 5012))
            ]
        )
        for policy in (Proportional, Copy)
    }
    assert 0.0 < sag[Proportional] < 0.5 * sag[Copy]


def test_beats_holding_still_and_copying_in_the_quick_suite():
    suite = make_suite("quick-v1")
    for scenario in suite.scenarios:
        made = Lift(scenario)
        for seed in suite.seeds:
            played = [run_episode(made, policy(), seed) for policy in (Proportional, Copy, Hold)]
            assert played[0].failure is None
            error, copied, held = (episode.scores["rmse_mm"] for episode in played)
            assert error < copied < held


def test_the_template_of_a_submission_is_the_same_policy():
    ours, template = Proportional(), PolicySpec(text=f"{TEMPLATE}:Policy").make()
    for policy in (ours, template):
        policy.reset(0)
    assert [template.act(view) for view in VIEWS] == [ours.act(view) for view in VIEWS]


@pytest.mark.parametrize("gain", [0.0, -1.0, np.inf, np.nan])
def test_an_impossible_gain_is_refused(gain):
    with pytest.raises(InputError, match=f"gain must be a positive number, got {gain}"):
        ProportionalParameters(gain=gain)
