"""Each policy of the ball: conformance, and what it does on made-up observations."""

import numpy as np
import pytest
from colift.agents.tasks.ball.ball_admittance import BallAdmittance, BallAdmittanceParameters
from colift.agents.tasks.ball.ball_calm import BallCalm, BallCalmParameters
from colift.agents.tasks.ball.ball_game import BallGame, BallGameParameters
from colift.agents.tasks.ball.ball_steady import BallSteady, BallSteadyParameters
from colift.agents.tasks.ball.facts import BALL_WEIGHT
from colift.agents.tasks.ball.observation import BallObservation
from colift.base.errors import InputError
from colift.benchmark.tasks.ball.task import BallSteering
from colift.testing import check_policy

ALL = (BallAdmittance, BallCalm, BallGame, BallSteady)
PARAMETERS = (
    BallAdmittanceParameters,
    BallCalmParameters,
    BallGameParameters,
    BallSteadyParameters,
)


def raised(policy, *, place=0.0, speed=0.0, target=None, force=0.0, steps=12):
    """Return how far a policy's hand is above a human who stands still, after so many steps."""
    policy.reset(0)
    command = 0.0
    for step in range(steps):
        seen = np.zeros(len(BallObservation))
        seen[BallObservation.HAND_COMMAND] = seen[BallObservation.HAND_HEIGHT] = command
        seen[BallObservation.TIME] = 0.1 * step
        seen[BallObservation.FORCE] = BALL_WEIGHT / 2 + force
        seen[BallObservation.BALL_PLACE] = place + 0.1 * speed * step
        if target is not None:
            seen[BallObservation.TARGET_PLACE], seen[BallObservation.TARGET_KNOWN] = target, 1.0
        command += min(max(float(policy.act(seen)[0]), -0.04), 0.04)
    return command


@pytest.mark.parametrize("policy", ALL)
def test_it_conforms(policy):
    check_policy(policy, BallSteering())


@pytest.mark.parametrize("parameters", PARAMETERS)
def test_negative_parameters_are_refused(parameters):
    with pytest.raises(InputError, match="steepest must be a number of at least 0, got -1"):
        parameters(steepest=-1.0)


@pytest.mark.parametrize("policy", [BallCalm, BallGame, BallSteady])
def test_a_ball_that_lies_where_it_should_is_left_alone(policy):
    """For a short time: this ball does not roll, whatever the table does."""
    assert abs(raised(policy(), steps=8)) < 0.008


@pytest.mark.parametrize("policy", [BallGame, BallSteady])
def test_the_end_towards_which_the_ball_is_too_far_is_raised(policy):
    """The middles of both: nothing but the ball's place differs."""
    assert raised(policy(), place=0.1, target=0.0) > 0.01
    assert raised(policy(), place=0.0, target=0.1) < -0.01


@pytest.mark.parametrize("policy", ALL)
def test_the_ball_is_slowed_down(policy):
    assert raised(policy(), speed=0.1, steps=8) > raised(policy(), speed=-0.1, steps=8) + 0.01


def test_admittance_inclines_as_often_as_the_wrists_mean():
    """A force of -0.5 N at the far hands means the far end up; the gain is the parameter's."""
    some = raised(BallAdmittance(), force=-0.5, steps=2)
    none = raised(BallAdmittance(parameters=BallAdmittanceParameters(admittance=0.0)), force=-0.5)
    assert some > 0.03
    assert abs(none) < 0.008


def test_calm_has_no_idea_of_a_target():
    assert raised(BallCalm(), target=0.1) == raised(BallCalm())


def test_game_infers_the_side_of_the_target_from_the_wrists():
    """Wrists that mean the far end up want the ball nearer to the human."""
    policy = BallGame()
    raised(policy, force=-0.5, steps=6)
    assert policy.internals()["inferred_aim"] < -0.02
    raised(policy, force=0.5, steps=6)
    assert policy.internals()["inferred_aim"] > 0.02
