"""Precedence at two hurdles: the time to go to one's own."""

from typing import Any, Final, Generic, NamedTuple

from colift.agents.rules import ArrayFunctions, N
from colift.benchmark.tasks.agree.manner import AgreeingManner

NEEDED: Final = 0.9
"""Time that a passage needs, with the stay [s]."""

EARLY: Final = 0.25
"""Time before the window opens at which a passage may begin [s]."""

NEAR: Final = 0.006
FAR_NEAR: Final = 0.015
"""Distances of the person's end and of the far end from the hurdle within which the table is there
[m]."""

AWAY: Final = 0.02
"""Distance from the common height beyond which a partner has a goal of its own [m]."""

LEVEL: Final = 0.008
"""Height difference of the ends within which the table is level [m]."""

SLOW: Final = 0.05
"""Speed below which the table rests there [m/s]."""

SERVED: Final = 0.2
"""Time that the table rests at the partner's goal until the person takes that hurdle as passed
[s]."""

STUBBORN: Final = 1.0
"""Insistence from which a person lets nobody go first [s]."""

STAYED: Final = 0.2
"""Time that the table stays at the person's own hurdle until the person takes it as passed [s]."""


class Secret(NamedTuple, Generic[N]):
    """A hurdle as its holder knows it."""

    height: N
    """Height to pass [m]."""
    start: N
    """When its window opens, from now [s]."""
    stop: N
    """When it closes, from now [s]."""
    given: N
    """1 if there is a hurdle; otherwise all four are 0."""


class Obstacle(NamedTuple, Generic[N]):
    """A hurdle of a lift."""

    height: N
    """Height to pass [m]."""
    start: N
    """First frame of its window."""
    stop: N
    """Frame after its last."""
    given: N
    """1 if there is a hurdle; otherwise all four are 0."""


def secret(f: ArrayFunctions[N], hurdle: Obstacle[N], frame: Any) -> Secret[N]:
    """Return a hurdle as its holder knows it at the end of a frame."""
    given = hurdle.given > 0.0
    start, stop = (
        f.where(given, f.seconds(each - frame), 0.0) for each in (hurdle.start, hurdle.stop)
    )
    return Secret(hurdle.height, start, stop, hurdle.given)


class Turn(NamedTuple, Generic[N]):
    """What a person keeps of the agreement from step to step; at the beginning 0 and False."""

    rested: N
    """Time for which the table has rested at a goal of the partner's [s]."""
    stayed: N
    """Time for which the table has stayed at the person's own hurdle [s]."""
    conflict: N
    """Time for which both have been going to their own goals [s]."""
    begun: Any
    """Whether the person has set out to the own hurdle."""
    served: Any
    """Whether the partner has been at its goal."""
    yielded: Any
    """Whether the person has given way."""
    passed: Any
    """Whether the table has passed the person's hurdle."""


class Sight(NamedTuple, Generic[N]):
    """What a person sees of the table at the common height."""

    own: N
    """Height of the person's end, as felt now [m]."""
    far: N
    """Height of the far end, one visual delay ago [m]."""
    common: N
    """The common height [m]."""
    speed: N
    """Speed of the far end [m/s]."""


def served(f: ArrayFunctions[N], turn: Turn[N], seen: Sight[N], period: float) -> Turn[N]:
    """Return the turn after a look at whether the table rests, level, at a goal of the partner's.

    ``period`` is the time since the last look [s].
    """
    away = f.abs(seen.far - seen.common) > AWAY
    level = f.abs(seen.far - seen.own) < LEVEL
    resting = f.logical_and(f.logical_and(away, level), seen.speed < SLOW)
    rested = f.where(resting, turn.rested + period, 0.0)
    return turn._replace(rested=rested, served=f.logical_or(turn.served, rested >= SERVED))


def mine(
    f: ArrayFunctions[N],
    manner: AgreeingManner[N],
    turn: Turn[N],
    hurdle: Secret[N],
    seen: Sight[N],
    apart: Any,
    period: float,
) -> tuple[Turn[N], Any]:
    """Return the turn after a step, and whether the person goes to the own hurdle now.

    The turn comes at the share ``patience`` of the time between the earliest and the latest moment
    to begin, or as soon as the partner has been at its own goal. A partner who is seen to go to a
    goal of its own may go first, up to the latest moment, unless the person is stubborn. If both
    have begun, the person insists for a while and then gives way, until the partner has been at its
    goal.

    ``apart`` is whether the partner goes to a goal of its own, ``period`` the time of a step [s].
    """
    given = hurdle.given > 0.0
    ends = f.logical_and(
        f.abs(seen.own - hurdle.height) < NEAR, f.abs(seen.far - hurdle.height) < FAR_NEAR
    )
    there = f.logical_and(f.logical_and(given, hurdle.start <= 0.0), ends)
    stayed = f.where(there, turn.stayed + period, 0.0)
    passed = f.logical_or(turn.passed, stayed > STAYED)
    earliest, latest = hurdle.start - EARLY, hurdle.stop - NEEDED
    patience = f.where(turn.served, 0.0, manner.patience)
    due = earliest + patience * (latest - earliest) <= 0.0
    ahead = f.logical_and(f.logical_not(passed), hurdle.stop > 0.0)
    open_now = f.logical_and(given, f.logical_and(ahead, due))

    free = f.logical_or(f.logical_not(apart), turn.served)
    begins = f.logical_or(f.logical_or(free, latest <= 0.0), manner.insistence > STUBBORN)
    goes_on = f.logical_and(open_now, turn.begun)
    contested = f.where(apart, turn.conflict + period, 0.0)
    conflict = f.where(goes_on, contested, turn.conflict)
    yields = f.logical_and(goes_on, conflict > manner.insistence)
    yielded = f.logical_or(turn.yielded, yields)
    held = f.logical_or(turn.served, f.logical_not(yielded))
    goes = f.logical_and(
        open_now,
        f.logical_or(
            f.logical_and(turn.begun, held), f.logical_and(f.logical_not(turn.begun), begins)
        ),
    )
    begun = f.logical_or(turn.begun, f.logical_and(open_now, begins))
    turn = turn._replace(
        stayed=stayed, conflict=conflict, begun=begun, yielded=yielded, passed=passed
    )
    return turn, goes
