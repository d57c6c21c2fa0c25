"""Environments of the twin by the name of a task."""

from collections.abc import Callable
from typing import Any, Final

import jax
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import ANY, DRAW, Drawing, make_drawing
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.benchmark.suites.catalogue import TASK
from colift.benchmark.twin.bulk import many_lifts
from colift.benchmark.twin.drawing import check_modelled, common_rules, draw_lift, stack
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.twin_environment.environment import ROBOT, TwinEnv
from colift.benchmark.twin_environment.pool import LiftPool
from colift.benchmark.twin_environment.spaces import Box

BOTH: Final = "both"
"""Both agents learn."""

LIFTS: Final = 1000
"""Number of lifts from which an environment draws."""


def make(
    task: str = TASK,
    *,
    agents: str = ROBOT,
    behaviour: str = ANY,
    subject: str = DRAW,
    control_period: float = CONTROL_PERIOD,
    latency: float = LATENCY,
    lifts: int = LIFTS,
    plans: int | None = None,
    seed: int = 0,
    box: Callable[..., Any] = Box,
    single: bool = False,
) -> TwinEnv:
    """Return the environment of a task.

    Parameters
    ----------
    task
        Its name: ``"level"``, or that of a task that is stated by rules.
    agents
        ``"robot"``: the person is that of the task; ``"both"``: the person learns, too.
    behaviour, subject, control_period, latency
        As for :func:`.parallel_env`; by default behaviours and people are drawn.
    lifts
        Number of lifts from which the environment draws; they are played again with other actions.
    plans
        Number of plans, and of people's bodies, that these lifts have in turn; the rest is drawn
        anew for each (:func:`.many_lifts`). None: each lift has its own, as in the engine.
    seed
        Draws these lifts.
    box, single
        See :class:`.TwinEnv`.

    Raises
    ------
    InputError
        If a setting is out of range, or the twin does not model the task.
    """
    if agents not in (ROBOT, BOTH):
        raise InputError(f"agents must be {ROBOT!r} or {BOTH!r}, got {agents!r}")
    drawing = drawing_of(task, behaviour, subject, control_period, latency)
    twin, pool = TaskTwin.of(drawing.scenarios), drawn_pool(drawing, lifts, seed, plans)
    return TwinEnv(twin, pool, learns=agents == BOTH, box=box, single=single)


def drawing_of(
    task: str, behaviour: str, subject: str, control_period: float, latency: float
) -> Drawing:
    """Return the source of lifts of an environment; see :func:`make`.

    Raises
    ------
    InputError
        If a setting is out of range, nothing is to be drawn, or the twin does not model the task.
    """
    drawing = make_drawing(behaviour, subject, DEFAULT_ROBOT, control_period, latency, task)
    if drawing is None:
        raise InputError("the twin draws its lifts: behaviour 'any', subject 'draw', or both")
    for scenario in drawing.scenarios:
        check_modelled(scenario)
    return drawing


def check_counts(lifts: int, plans: int | None) -> None:
    """Raise an InputError if there are no lifts, or more plans than lifts."""
    if lifts < 1:
        raise InputError(f"lifts must be at least 1, got {lifts}")
    if plans is not None and not 1 <= plans <= lifts:
        raise InputError(f"plans must be 1 to {lifts}, the number of lifts, got {plans}")


def drawn_pool(drawing: Drawing, lifts: int, seed: int, plans: int | None = None) -> LiftPool:
    """Return lifts of a source, which the seed draws; see :func:`make`.

    Raises
    ------
    InputError
        If there is none, or there are more plans than lifts.
    """
    check_counts(lifts, plans)
    own = lifts if plans is None else plans
    rules = common_rules(drawing.scenarios)
    chosen = [drawing.lift(derive_seed(seed, f"lift {number}")) for number in range(own)]
    drawn = stack([draw_lift(scenario, each, rules) for scenario, each in chosen])
    if own < lifts:
        key = jax.random.key(derive_seed(seed, "many"))
        drawn = many_lifts(TaskTwin.of(drawing.scenarios), drawn, lifts, key)
    return LiftPool(drawn)
