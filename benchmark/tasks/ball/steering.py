"""Steering of the ball with one end of the table."""

import math
from typing import Final, Generic, NamedTuple

from colift.agents.agent import FRAME
from colift.agents.rules import ArrayFunctions, N
from colift.agents.tasks.ball.facts import HALF_WEIGHT, PULL, meant_by_wrists
from colift.benchmark.tasks.ball.manner import SteeringManner

DAMPING_RATIO: Final = 0.8
"""Damping ratio with which people bring the ball to its target."""

STEEPEST: Final = 0.08
"""Largest wanted height difference of the ends [m]."""

FARTHEST: Final = 0.1
"""Largest distance of the person's end from the plan of the lift [m]."""

FASTEST: Final = 0.25
"""Highest speed that steering adds to the person's end [m/s]."""

HAND_TIME: Final = 0.2
"""Time constant with which the person's end approaches its wanted height [s], an assumption: with a
smaller one, two people who steer oscillate, and the error of a lift depends on differences of
micrometres."""

MEMORY: Final = 2.0
"""Time over which a person judges the partner [s]."""

JOINING: Final = 1.2
"""Height difference that a person who does not know the target makes, relative to the one that the
other's wrists seem to mean."""

CALMING: Final = 0.2
"""Height difference that such a person adds against the ball's speed [m per m/s]."""

SQUARE: Final = 1e-4
"""Sum of squares in the regression of the partner's part at the beginning [m2 s]."""


class SteeringMemory(NamedTuple, Generic[N]):
    """What a person keeps from step to step; at the beginning 0, and ``square`` :data:`SQUARE`."""

    offset: N
    """Distance of the person's end from the plan, due to steering [m]."""
    wanted: N
    """Height difference that the person wanted in the last step [m]."""
    product: N
    """Sum of products in the regression of the partner's part [m2 s]."""
    square: N
    """Sum of squares in that regression [m2 s]."""


class BallTarget(NamedTuple, Generic[N]):
    """Intended places of the ball at three times, equally spaced [m]."""

    first: N
    middle: N
    last: N


class SteeringSenses(NamedTuple, Generic[N]):
    """What a person perceives, all of it one visual delay ago but the target and the force."""

    own: N
    """Height of the person's end [m]."""
    other: N
    """Height of the other end [m]."""
    planned: N
    """The person's planned height then [m]."""
    place: N
    """Place of the ball [m]."""
    speed: N
    """Its speed [m/s]."""
    target: BallTarget[N]
    """Its intended places in the coming frames; 0 if the person does not know them."""
    span: float
    """Time between two of these [s]."""
    known: N
    """1 if the person knows the target, else 0."""
    felt: N
    """Mean force of the hands beyond half of the table's weight [N]; only a person who does not
    know the target uses it."""


def steer(
    f: ArrayFunctions[N],
    manner: SteeringManner[N],
    memory: SteeringMemory[N],
    senses: SteeringSenses[N],
    side: float,
    frames: int,
) -> tuple[SteeringMemory[N], list[N]]:
    """Return the memory after a step, and the distance of the person's end from the plan [m].

    With the haste w, the damping ratio z, and the ball's place s and speed v as seen a visual delay
    ago and extrapolated by the person's lead, the person wants the height difference

        d = (w^2 (s - x) + 2 z w (v - x') - x'') / PULL,

    far above near, for a target at x. The person's end makes the part ``share (1 - trust done)`` of
    it. ``done`` is the part that the partner seems to do: the regression, over the last seconds, of
    the other end's distance from the lift on the wanted difference.

    A person who does not know the target wants a multiple of the height difference that the other's
    wrists seem to mean (:func:`.meant_by_wrists`), less a term that slows down the ball, and makes
    all of it.

    ``side`` is 1 for the far end, whose height makes the difference larger, and -1 for the near
    one. The distances are those at the end of each frame.
    """
    period = frames * FRAME
    partner = -side * (senses.other - senses.planned)
    kept = math.exp(-period / MEMORY)
    product = kept * memory.product + period * partner * memory.wanted
    square = kept * memory.square + period * memory.wanted**2
    done = f.clip(product / (square + SQUARE), 0.0, 1.0)
    wanted = f.clip(_wanted(f, manner, senses, side), -STEEPEST, STEEPEST)
    known = senses.known > 0.5
    share = f.where(known, manner.share * (1.0 - manner.trust * done), 1.0)
    aim = f.clip(side * share * wanted, -FARTHEST, FARTHEST)
    offset, offsets = memory.offset, []
    for _ in range(frames):
        change = (aim - offset) * FRAME / HAND_TIME
        offset = offset + f.clip(change, -FASTEST * FRAME, FASTEST * FRAME)
        offsets.append(offset)
    return SteeringMemory(offset, wanted, product, square), offsets


def _wanted(
    f: ArrayFunctions[N], manner: SteeringManner[N], senses: SteeringSenses[N], side: float
) -> N:
    """Return the wanted height difference [m], without its limit."""
    seen = side * (senses.own - senses.other)
    lead, rate, target, span = manner.lead, manner.haste, senses.target, senses.span
    place = senses.place + lead * senses.speed - PULL * seen * lead * lead / 2
    speed = senses.speed - PULL * seen * lead
    slip = speed - (target.last - target.first) / (2 * span)
    push = (target.last - 2 * target.middle + target.first) / span**2
    known = (rate**2 * (place - target.middle) + 2 * DAMPING_RATIO * rate * slip - push) / PULL
    meant = meant_by_wrists(senses.felt, seen, place)
    return f.where(senses.known > 0.5, known, JOINING * meant + CALMING * speed)


def felt(forces: list[float]) -> float:
    """Return the mean of forces of the hands beyond half of the table's weight [N]."""
    return math.fsum(forces) / len(forces) - HALF_WEIGHT
