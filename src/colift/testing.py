"""Conformance checks for policies, behaviours, robots, tasks and suites, for use in any test suite.

Each raises an AssertionError that states the violated rule. Everything that colift registers
passes them.
"""

import contextlib
import dataclasses
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from colift.agents.actions import ActionError, checked_action
from colift.agents.agent import FRAME, Agent, Explaining, Remembering, RobotObservation
from colift.agents.humans import GOAL_RANGE, SUBJECTS, Behaviour, Plan, Subject
from colift.agents.policies.copy import Copy
from colift.base.errors import InputError, PolicyError
from colift.base.plugins import article, error_at, place_of
from colift.base.registry import TASKS, entries
from colift.benchmark.bundle.recipe import FROM_NAMES, Recipe
from colift.benchmark.episode.blame import blaming_plugins, check_episode
from colift.benchmark.episode.conformance import (
    behaviour_fault,
    observation_fault,
    plan_fault,
    rewards_fault,
    task_fault,
)
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.replay import replay
from colift.benchmark.episode.seat import body_parameters
from colift.benchmark.episode.task import Task
from colift.benchmark.robots.conformance import robot_conformance_fault
from colift.benchmark.robots.robot import Robot
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite, plain_name
from colift.benchmark.tasks.level.task import LEVEL

ROUNDING: Final = 1e-9
"""Rounding of heights [m]."""

PLANS: Final = 60
"""Number of plans of a behaviour that are checked."""

FASTEST: Final = 0.5
"""Highest speed of a plan [m/s]; people lift at up to 0.3 m/s."""

OBSERVED: Final = 40
"""Number of steps of the lift with which a policy is checked."""

STEEPEST: Final = 4.5
"""Highest acceleration of a plan from frame to frame [m/s2]; the limit of ``jerky``."""


def check_policy(make: Callable[[], Agent], task: Task = LEVEL) -> None:
    """Check a robot policy on the observations of a made-up lift, or of a task's own lifts.

    It must return one finite number per step in double precision, change no observation, keep
    nothing from one episode to the next, or, if it has ``begin_session``, from one session to the
    next, and share no state with another object of its class. If
    it has internals, they must be finite and have the same names after every action.

    Parameters
    ----------
    make
        Returns a new policy: a class, or a function without arguments.
    task
        The task that it plays.
    """
    _require_none(task_fault(task), f"task {place_of(task)}")
    if not callable(make):
        raise AssertionError(
            f"check_policy takes a class, or a function that makes a policy, got {article(make)}"
        )
    policy = _made(make)
    title = f"policy {type(policy).__name__}"
    for method in ("reset", "act"):
        _require(callable(getattr(policy, method, None)), f"{title} has no method {method}()")
    hint = "; if it plays another task, give that: check_policy(Policy, task)"
    with _asserting(title, type(policy), hint if task == LEVEL else ""):
        _check_policy(policy, make, task)


def _made(make: Callable[[], Agent]) -> Agent:
    with _asserting(f"policy {getattr(make, '__name__', make)}: its constructor", make):
        return make()


def _check_policy(policy: Agent, make: Callable[[], Agent], task: Task) -> None:
    seen, others = (_observations(seed, task) for seed in (0, 1))
    # A lift of a robot that follows may end early.
    seen, others = seen[: len(others)], others[: len(seen)]
    before = seen.copy()
    alone = _actions(policy, seen)
    _require(np.array_equal(seen, before), "act must leave the observation unchanged")
    used = make()
    _actions(used, others[::-1])
    remembers = isinstance(used, Remembering)
    cleared = (
        "begin_session must clear the last session"
        if remembers
        else "reset must clear the last episode"
    )
    _require(np.array_equal(_actions(used, seen), alone), cleared)
    one, other = make(), make()
    _begin(one, 3)
    _begin(other, 4)
    together = []
    for view, elsewhere in zip(seen, others, strict=True):
        together.append(np.array(one.act(view), dtype=np.float64).reshape(1))
        other.act(elsewhere)
    _require(np.array_equal(together, alone), "two objects of the class must not share state")
    explaining = make()
    if isinstance(explaining, Explaining):
        _check_internals(explaining, seen)


def _check_internals(policy: Explaining, seen: NDArray[np.float64]) -> None:
    assert isinstance(policy, Agent)
    _begin(policy, 0)
    found: list[Mapping[str, float]] = []
    for view in seen:
        policy.act(view)
        found.append(policy.internals())
    _require(len({tuple(each) for each in found}) == 1, "internals must have the same names always")
    finite = all(np.isfinite(list(each.values())).all() for each in found)
    _require(finite, "internals must be finite numbers")
    for name in ("confidence", "role"):
        inside = all(0.0 <= each.get(name, 0.0) <= 1.0 for each in found)
        _require(inside, f"the internal {name} must be in [0, 1]")


def check_behaviour(behaviour: Behaviour) -> None:
    """Check the plans of a human behaviour for the five subjects and for new people.

    A plan begins and ends at rest at height 0, has no steps in position or velocity, reaches a
    goal within ``GOAL_RANGE``, moves in its strokes only, depends on subject and seed alone, is
    read-only, and differs from seed to seed.
    """
    title = f"behaviour {place_of(behaviour)}"
    _require_none(behaviour_fault(behaviour), title)
    known = list(SUBJECTS.values())
    targets = set()
    for seed in range(PLANS):
        person = Subject.draw(seed) if seed % 3 == 0 else known[seed % len(known)]
        fault = plan_fault(behaviour, person, seed)
        _require_none(fault, f"{title}: plan() of {person.name} with seed {seed}")
        plan = behaviour.plan(person, seed)
        with _asserting(title, type(behaviour)):
            _check_plan(plan, f"{title}, {person.name} with seed {seed}")
        again = behaviour.plan(person, seed)
        same = np.array_equal(plan.target, again.target) and plan.strokes == again.strokes
        _require(same, f"{title}: a plan must depend on the subject and the seed alone")
        targets.add(plan.target.tobytes())
    _require(len(targets) > 0.9 * PLANS, f"{title}: plans must differ from seed to seed")


def _check_plan(plan: Plan, which: str) -> None:
    target = plan.target
    velocity = np.diff(target, prepend=0.0) / FRAME
    lowest, highest = GOAL_RANGE
    _require(
        plan.goal == target.max(),
        f"{which}: the goal is {plan.goal} m; must be the highest target, {target.max()} m",
    )
    _require(
        lowest - ROUNDING <= plan.goal <= highest + ROUNDING,
        f"{which}: the highest target is {plan.goal:.4f} m; must be in GOAL_RANGE, {lowest} to "
        f"{highest} m",
    )
    ends = max(abs(float(target[0])), abs(float(target[-1])))
    _require(ends < ROUNDING, f"{which}: the plan must begin and end at height 0")
    speed, change = np.abs(velocity).max(), np.abs(np.diff(velocity)).max() / FRAME
    _require(speed < FASTEST, f"{which}: {speed:.2f} m/s is too fast; at most {FASTEST} m/s")
    _require(change < STEEPEST, f"{which}: the velocity has a step of {change * FRAME:.3f} m/s")
    moving = np.zeros(len(target), dtype=bool)
    for start, stop in plan.strokes:
        moving[start:stop] = True
    resting = np.abs(velocity[~moving])
    _require(bool(moving.any()), f"{which}: there must be a stroke")
    _require(not resting.size or resting.max() <= 0.02, f"{which}: it moves outside its strokes")
    _require(not target.flags.writeable, f"{which}: the target must be read-only")


def check_robot(robot: Robot) -> None:
    """Check a robot by letting it hold the table with a person.

    It must be a frozen dataclass with all that a robot has; hold the table within 20 mm of the
    commanded height; repeat itself bit for bit after a reset; and its postures must move joints of
    its model.
    """
    title = f"robot {place_of(robot)}"
    with _asserting(title, type(robot)):
        fault = robot_conformance_fault(robot, body_parameters(SUBJECTS["S3"]))
    _require_none(fault, title)


def check_task(task: Task, behaviour: str = "smooth") -> None:
    """Check a task by playing lifts with it: with a robot, a second human, and a robot that fails.

    It must be a frozen dataclass with all that a task has, and the name of its entry point, if it
    has one; its first metric is ``rmse_mm``; observations lie within the stated bounds; there is
    one score for each metric, finite or NaN, and no NaN where a score is never missing; the series
    it adds have one number per frame; the same actions give the same scores.
    """
    title = f"task {place_of(task)}"
    _require_none(task_fault(task), title)
    names = [name for name, each in entries(TASKS).items() if each.value == place_of(task)]
    _require(
        not names or task.name in names,
        f"{title} has the name {task.name!r}; its entry point has the name {', '.join(names)}",
    )
    for partner, fails in (("nao", False), ("human", False), ("nao", True)):
        scenario = dataclasses.replace(make_scenario(behaviour, "S1", partner), task=task)
        with _asserting(title, type(task)), contextlib.closing(Lift(scenario)) as lift:
            _check_played(title, lift, fails=fails)


class Watching:
    """An agent that checks its observations and rewards.

    As a robot it follows the human's end, as a second human it stays at rest.

    Parameters
    ----------
    lift
        The lift that is played.
    fails
        Whether it fails at once.
    """

    def __init__(self, lift: Lift, *, fails: bool) -> None:
        self._lift, self._fails = lift, fails
        self.fault: str | None = None
        """The first broken rule."""

    def reset(self, seed: int) -> None:
        """Begin an episode."""

    def act(self, observation: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the action; fail if a rule is broken."""
        lift = self._lift
        try:
            self.fault = observation_fault(lift) or (rewards_fault(lift) if lift.frame else None)
        except Exception as error:
            self.fault = f"raised {error_at(error, type(lift.task))}"
        if self._fails or self.fault is not None:
            raise PolicyError("on purpose")
        return Copy().act(observation) if lift.seat.is_robot else np.zeros(lift.partner_size)


def _check_played(title: str, lift: Lift, *, fails: bool) -> None:
    watching = Watching(lift, fails=fails)
    with blaming_plugins(lift.scenario, 0):
        episode = run_episode(lift, watching, 0)
    _require_none(watching.fault, f"{title}:")
    check_episode(lift, episode)
    trace = episode.trace
    with blaming_plugins(lift.scenario, 0):
        again = replay(lift, 0, trace.human_action, trace.action, episode.failure)
    same = repr(again.scores) == repr(episode.scores)
    _require(same, f"{title}: scores must follow from the actions")


def check_suite(suite: Suite) -> None:
    """Check that a suite can be published and verified, beyond being run.

    Its name must be plain ASCII, and its recipe, which goes into result bundles, must rebuild it.
    """
    if not isinstance(suite, Suite):
        raise AssertionError(f"check_suite takes a Suite, got {article(suite)}")
    plain = bool(suite.name) and plain_name(suite.name) == suite.name
    _require(plain, f"the name {suite.name!r} must be plain ASCII")
    _require(
        Recipe.of(suite) is not None,
        f"suite {suite.name!r}: its recipe does not rebuild it: {FROM_NAMES}",
    )


def _require(condition: bool, rule: str) -> None:
    if not condition:
        raise AssertionError(rule)


def _require_none(fault: str | None, title: str) -> None:
    _require(fault is None, f"{title} {fault}")


@contextlib.contextmanager
def _asserting(title: str, source: Any, hint: str = "") -> Iterator[None]:
    """Turn any error into an AssertionError that names the plugin and the place in its code."""
    try:
        yield
    except AssertionError:
        raise
    except InputError as error:
        raise AssertionError(str(error)) from error
    except ActionError as error:
        raise AssertionError(f"{title}: {error}") from error
    except Exception as error:
        raise AssertionError(f"{title} raised {error_at(error, source)}{hint}") from error


def _observations(seed: int, task: Task) -> NDArray[np.float64]:
    """Return the robot's observations of a lift, shape (40, 5) or that of the task."""
    return _made_up(seed) if task == LEVEL else _followed(seed, task)


def _followed(seed: int, task: Task) -> NDArray[np.float64]:
    """Return the observations of a robot that follows the human's end."""
    seen: list[NDArray[np.float64]] = []

    class Noting(Copy):
        """A policy that keeps its observations."""

        def act(self, observation: NDArray[np.float64]) -> NDArray[np.float64]:
            seen.append(observation.copy())
            return super().act(observation)

    scenario = dataclasses.replace(make_scenario("smooth", "S1"), task=task)
    with blaming_plugins(scenario, seed), contextlib.closing(Lift(scenario)) as lift:
        run_episode(lift, Noting(), seed)
    return np.array(seen[:OBSERVED])


def _made_up(seed: int) -> NDArray[np.float64]:
    """Return the robot's observations of a made-up lift with a hand that lags, shape (40, 5)."""
    rng = np.random.default_rng(seed)
    step = np.arange(40)
    human = 0.1 * (1 - np.cos(np.pi * step / 39))
    hand = np.concatenate(([0.0], human[:-1]))
    seen = np.zeros((40, len(RobotObservation)))
    seen[:, RobotObservation.HUMAN_END] = human
    for index in ("ROBOT_END", "HAND_HEIGHT", "HAND_COMMAND"):
        seen[:, RobotObservation[index]] = hand
    seen[:, RobotObservation.TIME] = 0.1 * step
    seen[:, :3] += rng.normal(0.0, 2e-4, (40, 3))
    return seen


def _begin(policy: Agent, seed: int) -> None:
    """Begin a lift with a new person."""
    if isinstance(policy, Remembering):
        policy.begin_session()
    policy.reset(seed)


def _actions(policy: Agent, seen: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a policy's actions in an episode, each checked, shape (n, 1)."""
    _begin(policy, 3)
    kept = []
    for view in seen:
        action = policy.act(view)
        checked_action("the robot", action, 1)
        array = np.asarray(action, dtype=np.float64)
        kept.append((array, array.copy()))
    _require(
        all(np.array_equal(now, then) for now, then in kept),
        "an action must not change after it was returned",
    )
    return np.array([then.reshape(1) for _, then in kept])
