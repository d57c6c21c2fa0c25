import numpy as np
import pytest
from colift.agents.control.predictor import Predictor
from colift.agents.policies.proactive import Proactive


def seen(human, hand=0.0, time=0.0):
    return np.array([human, 0.3, hand, -0.3, time])


def test_goes_to_the_predicted_height():
    policy, predictor = Proactive(), Predictor()
    policy.reset(0)
    predictor.reset()
    rng = np.random.default_rng(7)
    for k in range(40):
        view = seen(rng.uniform(0.0, 0.05), rng.uniform(0.0, 0.2), 0.1 * k)
        prediction, confidence = predictor.step(view)
        assert view[2] + policy.act(view) == pytest.approx([prediction.height], abs=1e-15)
        assert policy.internals()["prediction"] == prediction.height
        assert policy.internals()["confidence"] == confidence


@pytest.mark.parametrize("speed", [-0.08, 0.05, 0.15])
def test_leads_a_steady_human_by_one_step(speed):
    policy = Proactive()
    policy.reset(0)
    for k in range(60):
        height = speed * 0.1 * k
        lead = policy.act(seen(height, hand=height, time=0.1 * k))[0]
    assert lead == pytest.approx(0.1 * speed, abs=1e-4)


def test_leads_whatever_the_confidence():
    policy = Proactive()
    policy.reset(0)
    for k in range(30):
        policy.act(seen(0.05 * (-1) ** k, time=0.1 * k))
        assert policy.internals()["role"] == 1.0
    assert policy.internals()["confidence"] < 0.01
