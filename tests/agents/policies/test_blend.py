import numpy as np
import pytest
from colift.agents.control.predictor import PredictorParameters
from colift.agents.policies.blend import Blend
from colift.agents.policies.proactive import Proactive
from colift.agents.policies.reactive import Reactive


def seen(human, hand=0.0, time=0.0):
    return np.array([human, 0.3, hand, -0.3, time])


def lift(noise=0.0):
    """Return what is seen of a lift with a pause, by a hand that is somewhere near."""
    rng = np.random.default_rng(11)
    k = np.arange(80)
    human = 0.01 * (np.clip(k, 10, 20) - 10) + 0.01 * (np.clip(k, 40, 50) - 40)
    human = human + noise * rng.standard_normal(80)
    hand = human + rng.uniform(-0.06, 0.06, 80)
    return [seen(*row) for row in zip(human, hand, 0.1 * k, strict=True)]


def run(policy, views):
    """Return the actions and the internals."""
    policy.reset(0)
    pairs = [(policy.act(view)[0], policy.internals()) for view in views]
    actions, internals = zip(*pairs, strict=True)
    return np.array(actions), internals


@pytest.mark.parametrize("reading", ["variance as rho", "standard deviation as rho"])
def test_every_action_is_equation_8_of_what_it_reports(reading):
    views = lift(noise=2e-3)
    actions, internals = run(Blend(parameters=PredictorParameters(reading=reading)), views)
    reactive = Reactive()
    for view, action, told in zip(views, actions, internals, strict=True):
        lead = told["prediction"] - view[2]
        follow = reactive.step(view)
        share = told["confidence"]
        assert action == pytest.approx(share * lead + (1 - share) * follow, abs=1e-15)
        assert told["role"] == share
    shares = [told["confidence"] for told in internals]
    assert min(shares) < 0.4 < 0.9 < max(shares)


def test_sure_of_itself_it_is_the_proactive_controller():
    rng = np.random.default_rng(1)
    views = [seen(0.1, 0.1 + rng.uniform(-0.05, 0.05), 0.1 * k) for k in range(30)]
    actions, internals = run(Blend(), views)
    assert [told["confidence"] for told in internals] == pytest.approx([1.0] * 30, abs=1e-12)
    assert actions == pytest.approx(run(Proactive(), views)[0], abs=1e-12)
    reactive = Reactive()
    assert np.abs(actions - [reactive.step(view) for view in views]).max() > 5e-3


def test_at_a_loss_it_is_the_reactive_controller():
    rng = np.random.default_rng(1)
    views = [seen(0.05 * (-1) ** k, rng.uniform(-0.1, 0.1), 0.1 * k) for k in range(80)]
    actions, internals = run(Blend(), views)
    assert internals[-1]["confidence"] < 1e-12
    reactive = Reactive()
    follow = [reactive.step(view) for view in views]
    assert actions[60:] == pytest.approx(follow[60:], abs=1e-12)
    assert np.abs(actions - run(Proactive(), views)[0])[60:].max() > 5e-3


def test_follows_at_a_change_of_motion_and_leads_in_between():
    internals = run(Blend(), lift())[1]
    role = np.array([told["role"] for told in internals])
    # It starts at 10, pauses at 20, goes on at 40 and stops at 50.
    assert role[10] > 0.95
    assert role[11:16].min() < 0.5
    assert role[39] > 0.95
    assert role[41:46].min() < 0.5
    assert role[75:].min() > 0.95


def test_reports_the_predicted_motion():
    views = [seen(0.01 * k, 0.01 * k, 0.1 * k) for k in range(60)]
    told = run(Blend(), views)[1][-1]
    assert told["prediction"] == pytest.approx(0.6, abs=2e-4)
    assert told["predicted_velocity"] == pytest.approx(0.1, abs=1e-3)
    assert told["predicted_acceleration"] == pytest.approx(0.0, abs=2e-3)
