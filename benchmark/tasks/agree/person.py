"""The person who has a hurdle to pass, and a partner who may have another."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Generic, NamedTuple

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import Subject
from colift.agents.humans.following import Along, FollowsPlan
from colift.agents.humans.person import Trait
from colift.agents.rules import ArrayFunctions, Drawn, N, View
from colift.benchmark.tasks.agree.manner import TRAITS, AgreeingManner, agreeing_manner
from colift.benchmark.tasks.agree.negotiating import (
    Agreeing,
    AgreeingSenses,
    Detour,
    approach,
    beginning,
    common_height,
    negotiate,
    response,
    rests,
)
from colift.benchmark.tasks.agree.precedence import secret
from numpy.typing import NDArray


class Sight(NamedTuple):
    """What is drawn of a person for a lift."""

    error: NDArray[np.float64]
    """Error of the far end's perceived speed, relative to its standard deviation: a number for each
    step, in each of its frames."""


class Negotiating(NamedTuple, Generic[N]):
    """The memory of a person with a hurdle."""

    agreeing: Agreeing[N]
    detour: Detour[N]


class Negotiates(FollowsPlan):
    """A :class:`.Person` who goes the common way, with detours to the own hurdle and the partner's.

    The person negotiates as :func:`.negotiate` and :func:`.response` say, and the hand's detour
    follows (:func:`.approach`). The answer to the felt force is the reflex of the body in the
    world. The task's facts must have the ``human`` hurdle (:class:`.Obstacle`) and the
    ``uncertainty``, the standard deviation of the error of the far end's perceived speed [m/s].
    """

    traits: ClassVar[Mapping[str, Trait]] = TRAITS

    def draw(
        self, subject: Subject, seed: Callable[[str], int], steps: int, size: int
    ) -> tuple[Sight, AgreeingManner[float]]:
        """Return the errors of sight, and the person's manner."""
        errors = np.random.default_rng((seed("human"), 1)).standard_normal(steps)
        return Sight(errors.repeat(size)), agreeing_manner(subject)

    def begin(self, f: ArrayFunctions[N], zero: N, no: Any) -> Negotiating[N]:
        """Return the memory at the beginning."""
        return Negotiating(beginning(f, zero, no), Detour(zero, zero))

    def intend(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[Negotiating[N], Along[N]]:
        """Return the common way with the detour."""
        facts, late = drawn.facts, view.visual
        way = drawn.target.next(view.frame, frames)
        resting = rests(f, way[0], way[-1], frames)
        senses = AgreeingSenses(
            own=view.seen("human_end", 0),
            then=view.seen("human_end", late),
            far=view.seen("robot_end", late),
            sight=facts.uncertainty * drawn.chance.error.at(view.frame),
            uncertainty=facts.uncertainty,
        )
        hurdle = secret(f, facts.human, view.frame)
        agreeing, goes = negotiate(
            f, drawn.manner, memory.agreeing, senses, hurdle, resting, way[-1], frames * FRAME
        )
        wanted = response(f, drawn.manner, agreeing, hurdle, goes)
        aim = f.where(resting, wanted - way[-1], 0.0)
        detour, heights = approach(f, memory.detour, aim, way)
        return Negotiating(agreeing, detour), Along(heights)

    def knows(
        self, f: ArrayFunctions[N], drawn: Drawn[N], memory: Any, view: View[N], frames: int
    ) -> tuple[N, ...]:
        """Return the common height while the way rests there, and the own hurdle."""
        way = drawn.target.next(view.frame, frames)
        resting = rests(f, way[0], way[-1], frames)
        common = common_height(f, memory.agreeing.common, resting, way[-1])
        own = secret(f, drawn.facts.human, view.frame)
        return 10.0 * common, 10.0 * own.height, 0.5 * own.start, 0.5 * own.stop, own.given
