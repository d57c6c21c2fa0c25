"""The twins of tasks with touch, as functions, with the manners of their people."""

from collections.abc import Callable, Sequence
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.humans.agree.manner import (
    INSISTENCES,
    STIFFNESSES,
    TRUSTS,
    AgreeingManner,
)
from colift.agents.humans.agree.manner import PATIENCES as PATIENCES_TO_AGREE
from colift.agents.humans.ball.manner import RANGES, SteeringManner
from colift.agents.humans.intent.manner import LEADS, PATIENCES, SHARES, LeadingManner
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.tasks.agree.task import BEHAVIOURS as HURDLES
from colift.benchmark.tasks.ball.task import BEHAVIOURS as ROLLINGS
from colift.benchmark.tasks.intent.task import BEHAVIOURS as INTENTS
from colift.benchmark.twin.agree_lifts import AgreeLifts, draw_agree, stack_agree
from colift.benchmark.twin.agree_playing import AGREE_STEPS
from colift.benchmark.twin.ball_lifts import BallLifts, draw_ball, stack_ball
from colift.benchmark.twin.ball_playing import BALL_STEPS
from colift.benchmark.twin.intent_lifts import IntentLifts, draw_intent, stack_intent
from colift.benchmark.twin.intent_playing import INTENT_STEPS
from colift.benchmark.twin.touch_rollout import TouchSteps


class TouchTwin(NamedTuple):
    """The twin of a task, as functions."""

    behaviours: Sequence[str]
    draw: Callable[[Scenario, int], Any]
    """Returns the drawn arrays of a lift."""
    stack: Callable[[Sequence[Any]], Any]
    """Returns drawn lifts, stacked."""
    steps: TouchSteps
    """The lifts, step by step."""
    manners: Callable[[Any, jax.Array, float], Any]
    """Returns lifts with new manners of their people, drawn by a key from ranges that are longer
    than the population's by a given share."""
    quiet: Callable[[Any], Any]
    """Returns lifts in which the people's wrists show no intention."""


def leading_anew(lifts: IntentLifts, key: jax.Array, wide: float) -> IntentLifts:
    """Return lifts with other manners (:class:`.LeadingManner`); see :class:`TouchTwin`."""
    drawn = jax.random.uniform(key, (3, lifts.size), minval=-wide / 2, maxval=1 + wide / 2)
    wrist, lead, patience = (
        low + (high - low) * share
        for (low, high), share in zip((SHARES, LEADS, PATIENCES), drawn, strict=True)
    )
    return lifts._replace(manner=LeadingManner(wrist=wrist, lead=lead, patience=patience))


def steering_anew(lifts: BallLifts, key: jax.Array, wide: float) -> BallLifts:
    """Return lifts with other manners (:class:`.SteeringManner`), all of the population's ranges.

    Beyond them, people who steer with an untrained robot fling the ball about, and gradients
    through such lifts overflow.
    """
    drawn = jax.random.uniform(key, (len(RANGES), lifts.size))
    manner = {
        name: low + (high - low) * share
        for (name, (low, high)), share in zip(RANGES.items(), drawn, strict=True)
    }
    return lifts._replace(manner=SteeringManner(**manner))


def agreeing_anew(lifts: AgreeLifts, key: jax.Array, wide: float) -> AgreeLifts:
    """Return lifts with other manners of people with hurdles; see :class:`TouchTwin`."""
    drawn = jax.random.uniform(key, (4, lifts.size), minval=-wide / 2, maxval=1 + wide / 2)
    ranges = (PATIENCES_TO_AGREE, TRUSTS, STIFFNESSES, INSISTENCES)
    patience, trust, stiffness, insistence = (
        low + (high - low) * share for (low, high), share in zip(ranges, drawn, strict=True)
    )
    manner = AgreeingManner(
        patience=jnp.maximum(patience, 0.0),
        trust=jnp.clip(trust, 0.0, 1.0),
        stiffness=jnp.clip(stiffness, 0.0, 1.0),
        insistence=jnp.maximum(insistence, 0.0),
    )
    return lifts._replace(manner=manner)


def leading_quietly(lifts: IntentLifts) -> IntentLifts:
    """Return lifts with wrists that stay level."""
    manner = lifts.manner
    return lifts._replace(manner=manner._replace(wrist=jnp.zeros_like(manner.wrist)))


def steering_quietly(lifts: BallLifts) -> BallLifts:
    """Return lifts with wrists that take no part in steering."""
    manner = lifts.manner
    return lifts._replace(manner=manner._replace(wrist=jnp.zeros_like(manner.wrist)))


def agreeing_quietly(lifts: AgreeLifts) -> AgreeLifts:
    """Return the lifts unchanged: people with hurdles keep their wrists level."""
    return lifts


TWINS: Final = {
    "intent": TouchTwin(
        INTENTS, draw_intent, stack_intent, INTENT_STEPS, leading_anew, leading_quietly
    ),
    "agree": TouchTwin(
        HURDLES, draw_agree, stack_agree, AGREE_STEPS, agreeing_anew, agreeing_quietly
    ),
    "ball": TouchTwin(ROLLINGS, draw_ball, stack_ball, BALL_STEPS, steering_anew, steering_quietly),
}
"""The twins by task."""
