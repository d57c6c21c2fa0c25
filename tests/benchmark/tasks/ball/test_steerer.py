"""How people steer the ball: by their share, late, and less beside a partner who does it."""

import math

import numpy as np
import pytest
from colift.agents.agent import HISTORY
from colift.agents.humans import SUBJECTS, Subject
from colift.agents.rules import SCALARS
from colift.agents.tasks.ball import facts
from colift.benchmark.tasks.ball.manner import MANNERS, TRAITS, SteeringManner, steering_manner
from colift.benchmark.tasks.ball.person import SteeringIntention, Steers
from colift.benchmark.tasks.ball.places import (
    FARTHEST,
    STRONGEST,
    WAY,
    BallPause,
    BallSmooth,
    BallSmoothShared,
)
from colift.benchmark.tasks.ball.steering import (
    SQUARE,
    BallTarget,
    SteeringMemory,
    SteeringSenses,
    steer,
)
from colift.benchmark.tasks.ball.task import Places
from colift.benchmark.world.ball import ROLLING, Ball
from colift.benchmark.world.table import (
    GRAVITY,
    GRIP_STIFFNESS,
    TABLE_LENGTH,
    WEIGHT_SHARE,
)
from colift.testing import check_behaviour

from ..past import Past, Walking, drawn_of

CALM = SteeringManner(share=0.5, haste=2.0, lead=0.0, trust=0.0, wrist=0.5)


def settled(manner, side=-1.0, steps=30, place=0.0, other=0.0, known=True):
    """Return where a person's end goes beyond the plan [m] when nothing moves."""
    memory = SteeringMemory(0.0, 0.0, 0.0, SQUARE)
    senses = SteeringSenses(
        own=0.0,
        other=other,
        planned=0.0,
        place=place,
        speed=0.0,
        target=BallTarget(0.0, 0.0, 0.0),
        span=0.04,
        known=float(known),
        felt=facts.BALL_WEIGHT / 2,
    )
    for _ in range(steps):
        memory, offsets = steer(SCALARS, manner, memory, senses, side, HISTORY)
    return offsets[-1]


def test_a_person_lifts_along_the_plan_beside_the_steering():
    """The intended height is the plan, and an offset for a ball away from its target."""
    plan = np.linspace(0.0, 0.1, 200)
    drawn = drawn_of(plan, CALM, series=Places(np.zeros(200)))
    view, walking = Past(read={"ball_place": [0.05] * 40}), Walking(Steers(), drawn)
    while view.frame < 200:
        walking.step(view)
    offsets = np.array(view.read["target"]) - plan
    assert offsets[-1] == pytest.approx(settled(CALM, steps=20, place=0.05), rel=0.1)
    difference, pitch = Steers().drive(SCALARS, drawn, SteeringIntention(0.1, 0.1), 0.08)
    assert difference == pytest.approx(0.02)
    assert pitch == pytest.approx(math.asin(0.02 / TABLE_LENGTH), rel=1e-6)


def test_both_partners_know_the_table_of_the_world():
    assert facts.LENGTH == TABLE_LENGTH
    assert pytest.approx(WEIGHT_SHARE) == facts.HALF_WEIGHT
    assert pytest.approx(Ball().mass * GRAVITY) == facts.BALL_WEIGHT
    assert pytest.approx(ROLLING * GRAVITY / TABLE_LENGTH) == facts.PULL
    assert facts.WRIST == GRIP_STIFFNESS


def test_a_person_lifts_the_near_end_to_send_the_ball_away():
    assert settled(CALM, place=-0.05) > 0.001
    assert settled(CALM, place=0.05) < -0.001
    assert settled(CALM, side=1.0, place=-0.05) < -0.001


def test_the_offset_is_the_share_of_what_a_partner_less_person_would_make():
    """share w^2 e / PULL at rest."""
    assert settled(CALM, place=0.05) == pytest.approx(-0.5 * 4.0 * 0.05 / facts.PULL, rel=1e-3)


def test_trust_leaves_the_steering_to_a_partner_who_does_it():
    wary = settled(CALM, place=0.05, other=0.02)
    trusting = SteeringManner(share=0.5, haste=2.0, lead=0.0, trust=0.5, wrist=0.5)
    assert abs(settled(trusting, place=0.05, other=0.02)) < 0.7 * abs(wary)


def test_one_who_does_not_know_the_target_leaves_a_resting_ball_alone():
    assert settled(CALM, side=1.0, known=False) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("behaviour", [BallSmooth(), BallPause()])
def test_plans_are_plans(behaviour):
    check_behaviour(behaviour)


def test_the_target_moves_as_a_ball_can():
    for seed in range(20):
        plan = BallSmooth().plan(SUBJECTS["S1"], seed)
        assert np.abs(plan.place).max() <= FARTHEST
        acceleration = np.diff(plan.place, 2) / 0.01**2
        assert np.abs(acceleration).max() < 1.05 * STRONGEST
        still = plan.place[np.diff(plan.place, append=plan.place[-1]) == 0.0]
        ways = np.abs(np.diff(still[np.abs(np.diff(still, prepend=still[0])) > 0.01], prepend=0.0))
        assert np.all(ways >= WAY[0] - 1e-9)
        assert not plan.place.flags.writeable


def test_a_shown_target_is_the_same_target():
    hidden = BallSmooth().plan(SUBJECTS["S2"], 3)
    shown = BallSmoothShared().plan(SUBJECTS["S2"], 3)
    assert np.array_equal(hidden.place, shown.place)
    assert (hidden.shown, shown.shown) == (False, True)


def test_people_differ_and_a_name_is_always_the_same_person():
    for name, manner in MANNERS.items():
        assert steering_manner(SUBJECTS[name]) is manner
    drawn = [steering_manner(Subject.draw(seed)) for seed in range(100_000, 100_020)]
    assert drawn[0] == steering_manner(Subject.draw(100_000))
    for name, (low, high, *_) in TRAITS.items():
        values = [getattr(manner, name) for manner in drawn]
        assert low <= min(values) < max(values) <= high
        assert max(values) - min(values) > 0.6 * (high - low)
    assert all(math.isfinite(value) for manner in drawn for value in manner)
