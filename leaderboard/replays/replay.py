"""Replays: one lift as JSON that is small enough to be mailed.

======================== =========================================================================
key                      content
======================== =========================================================================
format                   version of this table
policy, suite,           origin of the lift
suite_digest
behaviour, subject,      the episode; ``trial`` is the name of a recording, or empty
trial, seed
lift                     place of the lift in its session, from 1; only of sessions
which                    ``best``, ``median`` or ``worst`` of its behaviour; null if not chosen
failure                  reason of an early end, or null
scores                   the metrics of the episode; null where there is none
frame_s, period_s,       time of a frame and of a step, and the latency [s]; null if that is drawn
latency_s
horizon                  frames that the whole episode has, failed or not
human, robot, target     height of the human's end, of the robot's end and as intended by the human:
                         the first, then the changes from frame to frame [0.1 mm]; ``target`` is
                         empty in a live lift, since nobody knows what a real person intends
command                  where the policy sends the hands by the end of each step [0.1 mm]
prediction               its prediction of the human's end, step by step [0.1 mm]; or null
confidence, role         its other reports, step by step [1/1000]; or null
events                   the human's intentions, each with its first frame; none in a live lift
goals                    only of live lifts: the goals [0.1 mm], each with the frame in which it
                         appeared
goal_error_mm            only of live lifts: how far the hand was from them; null if the lift failed
drawn                    only of tasks that add some: the series of :class:`.DrawnSeries`, each
                         with ``name``, ``label``, ``where``, ``goal`` and ``values``, packed as
                         heights are
hurdles                  only of lifts that have some: each with ``label``, ``where``, ``height``
                         [0.1 mm], the frames ``start`` and ``stop`` of its window, the length
                         ``stay`` and the first frame ``nearest`` of the stay that came nearest,
                         and by how much that ``missed`` it [0.1 mm]; both null if there was none
holder                   only without a NAO: ``person``, another robot by its name, or words on one
                         without a picture
ghost                    ``human``, ``robot`` and ``drawn`` as above, and ``rmse_mm``, of two people
                         instead; ``team`` is true if both are simulated, and not one of them
======================== =========================================================================

Heights are within int16: 3.2 m. A number that a policy did not report is null.
"""

import contextlib
import dataclasses
import math
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import Plan, Played, goal_error_mm
from colift.agents.humans.serial import Serial
from colift.benchmark.bundle import one_line
from colift.benchmark.episode.blame import blaming_plugins
from colift.benchmark.episode.drawn import drawn_hurdles
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.trace import Trace
from colift.benchmark.execution.runner import finished
from colift.benchmark.rendering.bodies import PERSON, no_picture, shown_body
from colift.benchmark.results.baselines import partner_spec
from colift.benchmark.results.goals import lift_goal_errors
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.benchmark.suites.suite import Due, Suite
from numpy.typing import ArrayLike


@dataclass(frozen=True, kw_only=True, eq=False)
class Ghost:
    """The lift of two people, and the intention of the first of them."""

    episode: Episode
    plan: Plan
    """The same for every partner: it follows from scenario and seed."""
    horizon: int
    """Frames of the whole episode."""


def play_ghost(scenario: Scenario, seed: int) -> Ghost:
    """Play an episode with a second human at the robot's end; about 0.1 s.

    Raises
    ------
    InputError
        If the task or the behaviour of another package failed.
    """
    with contextlib.closing(Lift(dataclasses.replace(scenario, partner="human"))) as lift:
        with partner_spec(scenario).agent() as partner, blaming_plugins(scenario, seed):
            episode = run_episode(lift, partner, seed)
        return Ghost(episode=episode, plan=lift.plan, horizon=lift.horizon)


def play_ghosts(suite: Suite, places: Collection[int]) -> dict[int, Ghost]:
    """Return the ghosts of the lifts at some places of a suite.

    Two people in a session know each other from its lifts before.

    Raises
    ------
    InputError
        As :func:`play_ghost`.
    """
    people = suite.with_partner("human")
    without = {*range(suite.size)}.difference(places)
    played = dict(finished(partner_spec(suite.scenarios[0]), people, without=without))
    return {place: _ghost(people.at(place), played[place]) for place in places}


def _ghost(due: Due, episode: Episode) -> Ghost:
    with contextlib.closing(Lift(due.scenario)) as lift, blaming_plugins(due.scenario, due.seed):
        lift.reset(due.seed)
        return Ghost(episode=episode, plan=lift.plan, horizon=lift.horizon)


Which = Literal["best", "median", "worst"]
"""Reason for the choice of a replay."""

FORMAT: Final = 1

UNIT: Final = 1e-4
"""Unit to which heights are rounded [m]: below the noise of motion capture."""

LARGEST: Final = 2**15 - 1

PLACES: Final = 4
"""Decimals of the scores."""


def replay_content(
    episode: Episode,
    scenario: Scenario,
    ghost: Ghost,
    *,
    policy: str,
    suite: str = "",
    suite_digest: str = "",
    which: Which | None = None,
) -> dict[str, Any]:
    """Return a lift as JSON; see the table above.

    Parameters
    ----------
    episode
        The lift; it may have failed, even before its first frame.
    scenario
        Its scenario.
    ghost
        The human-human baseline in the same episode.
    policy
        The policy's name.
    suite, suite_digest
        The suite of the episode, if it is from one.
    which
        Reason for its choice.
    """
    trace = episode.trace
    human = scenario.human
    played = human if isinstance(human, Played) else None
    internals = trace.internals
    human_human = ghost.episode
    return {
        "format": FORMAT,
        "policy": policy,
        "suite": suite,
        "suite_digest": suite_digest,
        "behaviour": episode.behaviour,
        "subject": episode.subject,
        "trial": episode.trial,
        "seed": episode.seed,
        **({"lift": human.place + 1} if isinstance(human, Serial) else {}),
        "which": which,
        "failure": None if episode.failure is None else one_line(episode.failure),
        "scores": {name: _score(value) for name, value in episode.scores.items()},
        "frame_s": FRAME,
        "period_s": scenario.control_period,
        "latency_s": scenario.latency if scenario.conditions is None else None,
        "horizon": ghost.horizon,
        "human": changes(trace.human_end),
        "robot": changes(trace.robot_end),
        "target": [] if played else changes(trace.target),
        "command": _units(scenario.seat.hand_commands(trace.action, scenario.control_period), UNIT),
        "prediction": _said(internals.get("prediction"), UNIT),
        "confidence": _said(internals.get("confidence"), 1e-3),
        "role": _said(internals.get("role"), 1e-3),
        "events": [] if played else [[name, frame] for name, frame in ghost.plan.events],
        **({} if played is None else _goals(played, episode)),
        **_drawn(scenario, trace),
        **_hurdles(scenario, trace),
        **_holder(scenario.partner),
        "ghost": {
            "human": changes(human_human.trace.human_end),
            "robot": changes(human_human.trace.robot_end),
            **_drawn(scenario, human_human.trace),
            "rmse_mm": _score(human_human.scores["rmse_mm"]),
        },
    }


def _goals(played: Played, episode: Episode) -> dict[str, Any]:
    """Return the goals that a real person saw, and the goal error."""
    goals = [[cue.frame, *_units([cue.height], UNIT)] for cue in played.cue.cues()]
    reached = None if episode.failure is not None else goal_error_mm(lift_goal_errors(played))
    return {"goals": goals, "goal_error_mm": None if reached is None else _score(reached)}


def _drawn(scenario: Scenario, trace: Trace) -> dict[str, Any]:
    """Return the series that the task adds and pictures show; empty if there are none."""
    shown = [
        {
            "name": each.name,
            "label": each.label,
            "where": each.where,
            "goal": each.goal,
            "values": changes(trace.added[each.name]),
        }
        for each in drawn_series(scenario.task.metrics)
        if each.stay is None
    ]
    return {"drawn": shown} if shown else {}


def _hurdles(scenario: Scenario, trace: Trace) -> dict[str, Any]:
    """Return the hurdles of the lift; empty if there are none."""
    found = [
        {
            **dataclasses.asdict(each),
            "height": _units([each.height], UNIT)[0],
            "missed": None if each.missed is None else _units([each.missed], UNIT)[0],
        }
        for each in drawn_hurdles(drawn_series(scenario.task.metrics), trace)
    ]
    return {"hurdles": found} if found else {}


def _holder(partner: str) -> dict[str, str]:
    """Return the body at the robot's end unless it is a NAO: a person, or words in its place."""
    if partner == DEFAULT_ROBOT:
        return {}
    body = shown_body(partner)
    if body is None:
        return {"holder": no_picture(partner)}
    return {"holder": PERSON if body == PERSON else partner}


def changes(heights: ArrayLike) -> list[int]:
    """Return heights [m] as a first one and changes [0.1 mm]; their running sum has no drift."""
    values = _units(heights, UNIT)
    return [now - before for before, now in zip([0, *values], values, strict=False)]


def _units(values: ArrayLike, unit: float) -> list[int]:
    """Return finite numbers in whole units, within int16."""
    whole = np.rint(np.asarray(values, dtype=np.float64) / unit)
    return [int(value) for value in np.clip(whole, -LARGEST, LARGEST)]


def _said(values: Iterable[float] | None, unit: float) -> list[int | None] | None:
    """Return a policy's reports as numbers; None where it reported something else."""
    if values is None:
        return None
    found = [_units([value], unit)[0] if math.isfinite(value) else None for value in values]
    return found if any(value is not None for value in found) else None


def _score(value: float) -> float | None:
    return round(value, PLACES) if math.isfinite(value) else None
