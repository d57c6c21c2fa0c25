"""People who negotiate two hurdles, many at a time: belief, precedence and the way of the hand."""

import math
from typing import Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME
from colift.agents.estimators.belief import FARTHEST, GOALS, BeliefParameters
from colift.agents.humans.agree.negotiator import APART, PACE
from colift.agents.humans.agree.precedence import AWAY, FAR_NEAR, LEVEL, NEAR, SERVED, SLOW
from colift.benchmark.twin.agree_lifts import AgreeLifts
from colift.benchmark.twin.body import delayed
from colift.benchmark.twin.plant import Plant

_BELIEF: Final = BeliefParameters()


class AgreeMind(NamedTuple):
    """The memory of n people; all (n,) except the chances."""

    chances: jax.Array
    """(1 + g, n) probabilities that the partner comes along, and of each of its goals."""
    far: jax.Array
    """The far end as last seen [m]."""
    offset: jax.Array
    """Distance of the hand from the common way [m]."""
    rate: jax.Array
    """Its rate of change [m/s]."""
    begun: jax.Array
    """Whether they have set out to their own hurdle, see :class:`.Precedence`."""
    served: jax.Array
    """Whether the partner has been at its goal."""
    yielded: jax.Array
    """Whether they have given way."""
    passed: jax.Array
    """Whether the table has passed their hurdle."""
    conflict: jax.Array
    """Time for which both have been going to their own goals [s]."""
    rested: jax.Array
    """Time for which the table has rested at a goal of the partner's [s]."""


def agree_minds(count: int) -> AgreeMind:
    """Return people at the beginning of a lift."""
    zero, no = jnp.zeros(count), jnp.zeros(count, bool)
    return AgreeMind(_prior(count), zero, zero, zero, no, no, no, no, zero, zero)


def _prior(count: int) -> jax.Array:
    along = _BELIEF.along
    chances = [along] + [(1 - along) / len(GOALS)] * len(GOALS)
    return jnp.broadcast_to(jnp.asarray(chances)[:, jnp.newaxis], (len(chances), count))


def believed(
    chances: jax.Array,
    before: jax.Array,
    after: jax.Array,
    mine: jax.Array,
    common: jax.Array,
    period: float,
    noise: jax.Array,
) -> jax.Array:
    """Return the probabilities of goals after a motion of the partner; see :class:`.GoalBelief`.

    Parameters
    ----------
    chances
        (1 + g, n) probabilities before the motion.
    before, after, mine, common, noise
        As for :meth:`.GoalBelief.update`, all (n,).
    period
        Time of the motion [s].
    """
    moved = -math.expm1(-_BELIEF.pace * period)
    change = 1 - (1 - _BELIEF.change) ** (period / 0.1)
    spread = jnp.hypot(jnp.full_like(noise, _BELIEF.noise), noise) * period
    goals = jnp.concatenate((mine[jnp.newaxis], common + jnp.asarray(GOALS)[:, jnp.newaxis]))
    deviation = (after - before - moved * (goals - before)) / spread
    squares = jnp.minimum(deviation**2, FARTHEST)
    # The likeliest goal gets the weight 1, so that the sum cannot underflow to 0.
    squares = squares - jax.lax.stop_gradient(squares.min(axis=0))
    kept = (1 - change) * chances + change * _prior(len(mine))
    weighed = kept * jnp.exp(-0.5 * squares)
    normed: jax.Array = weighed / weighed.sum(axis=0)
    return normed


class AgreeSight(NamedTuple):
    """The input of n people in a step."""

    way: jax.Array
    """(f, n) the common way [m]."""
    common: jax.Array
    """(n,) see :class:`.AgreeLifts`, and so on."""
    times: jax.Array
    """(4, n)"""
    sight: jax.Array
    """(n,)"""


def negotiated(
    mind: AgreeMind, lifts: AgreeLifts, due: AgreeSight, plant: Plant
) -> tuple[AgreeMind, jax.Array]:
    """Return minds after a step, and the intended heights of the hands (f, n) [m].

    This is the counterpart of :class:`.Negotiator`. Decisions are made in single precision and have
    no gradient: a loss depends on a person's actions, not on how close a decision was.
    """
    size, body = len(due.way), lifts.body
    period = size * FRAME
    (then,) = delayed(plant.heights, body.seen, 1)
    far = then + delayed(plant.differences, body.seen, 1)[0]
    own, common, resting = plant.heights[0], due.common, due.common > 0.0

    seen = far + due.sight * period
    chances = believed(mind.chances, mind.far, seen, then, common, period, lifts.uncertainty)
    chances = jnp.where(resting, chances, _prior(lifts.size))
    middle = 1 + GOALS.index(0.0)
    apart = 1.0 - chances[0] - chances[middle] > APART

    rests = (jnp.abs(far - common) > AWAY) & (jnp.abs(far - own) < LEVEL)
    rests = rests & (jnp.abs(far - mind.far) / period < SLOW)
    rested = jnp.where(resting, jnp.where(rests, mind.rested + period, 0.0), mind.rested)
    mind = mind._replace(
        chances=chances,
        far=far,
        served=mind.served | (rested >= SERVED),
        rested=rested,
    )
    mind, mine = _precede(mind, lifts, due, apart, own, period)

    goal = common + lifts.manner.trust * (chances[1:] * jnp.asarray(GOALS)[:, jnp.newaxis]).sum(
        axis=0
    )
    goal = jnp.where(mine, lifts.human.height, goal)
    response = lifts.manner.stiffness * goal + (1 - lifts.manner.stiffness) * far
    aim = jnp.where(resting, response - due.way[-1], 0.0)
    offset, rate, heights = mind.offset, mind.rate, []
    for height in due.way:
        pull = PACE * PACE * (aim - offset) - math.sqrt(2.0) * PACE * rate
        rate = rate + pull * FRAME
        offset = offset + rate * FRAME
        heights.append(height + offset)
    return mind._replace(offset=offset, rate=rate), jnp.stack(heights)


def _precede(
    mind: AgreeMind,
    lifts: AgreeLifts,
    due: AgreeSight,
    apart: jax.Array,
    own: jax.Array,
    period: float,
) -> tuple[AgreeMind, jax.Array]:
    """Return minds, and whether it is their turn (n,); see :class:`.Precedence`."""
    start, stop, earliest, latest = due.times
    hurdle = lifts.human
    asked = (hurdle.given > 0.0) & (due.common > 0.0)
    there = (jnp.abs(own - hurdle.height) < NEAR) & (jnp.abs(mind.far - hurdle.height) < FAR_NEAR)
    passed = mind.passed | (asked & (start <= 0.0) & there)
    patience = jnp.where(mind.served, 0.0, lifts.manner.patience)
    open_now = asked & ~passed & (stop > 0.0) & (earliest + patience * (latest - earliest) <= 0.0)
    begins = ~apart | mind.served | (latest <= 0.0)
    goes_on = open_now & mind.begun
    conflict = jnp.where(goes_on, jnp.where(apart, mind.conflict + period, 0.0), mind.conflict)
    yielded = mind.yielded | (goes_on & (conflict > lifts.manner.insistence))
    mine = jnp.where(mind.begun, mind.served | ~yielded, begins) & open_now
    mind = mind._replace(
        begun=mind.begun | (open_now & begins), yielded=yielded, passed=passed, conflict=conflict
    )
    return mind, mine
