"""Conformance checks for policies, human behaviours, tasks and suites, for use in any test suite.

Each raises an AssertionError that states the violated rule. Everything that colift registers
passes them.
"""

import contextlib
import dataclasses
from collections.abc import Callable, Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .agents.agent import FRAME, Agent, Explaining, RobotObservation
from .agents.humans import GOAL_RANGE, SUBJECTS, Behaviour, Plan, Subject
from .agents.policies.copy import Copy
from .benchmark.bundle.recipe import Recipe
from .benchmark.episode.episode import Episode, run_episode
from .benchmark.episode.level import LEVEL
from .benchmark.episode.lift import Lift, make_lift
from .benchmark.episode.metric import LEADING
from .benchmark.episode.replay import replay
from .benchmark.episode.task import Task
from .benchmark.suites.catalogue import make_scenario
from .benchmark.suites.suite import Suite, plain_name

ROUNDING: Final = 1e-9
"""Rounding of heights [m]."""

PLANS: Final = 60
"""Plans of a behaviour that are checked."""

FASTEST: Final = 0.5
"""Highest speed of a plan [m/s]; people lift at up to 0.3 m/s."""

OBSERVED: Final = 40
"""Steps of a lift that a policy is checked with."""

STEEPEST: Final = 4.5
"""Highest acceleration of a plan from frame to frame [m/s2]; the limit of ``jerky``."""


def check_policy(make: Callable[[], Agent], task: Task = LEVEL) -> None:
    """Check a robot policy on the observations of a made-up lift, or of a task's own lifts.

    It must return one finite number per step in double precision, change no observation, keep
    nothing from one episode to the next, and share no state with another object of its class. If
    it has internals, they must be finite and have the same names after every action.

    Parameters
    ----------
    make
        Returns a new policy: a class, or a function without arguments.
    task
        The task that it plays.
    """
    seen, others = (_observations(seed, task) for seed in (0, 1))
    # A lift of a robot that follows may end early.
    seen, others = seen[: len(others)], others[: len(seen)]
    before = seen.copy()
    alone = _actions(make(), seen)
    _require(np.array_equal(seen, before), "act must leave the observation unchanged")
    used = make()
    _actions(used, others[::-1])
    _require(np.array_equal(_actions(used, seen), alone), "reset must clear the last episode")
    one, other = make(), make()
    one.reset(3)
    other.reset(4)
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
    policy.reset(0)
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
    known = list(SUBJECTS.values())
    targets = set()
    for seed in range(PLANS):
        person = Subject.draw(seed) if seed % 3 == 0 else known[seed % len(known)]
        plan = behaviour.plan(person, seed)
        _check_plan(plan, f"{type(behaviour).__name__} of {person.name} with seed {seed}")
        again = behaviour.plan(person, seed)
        same = np.array_equal(plan.target, again.target) and plan.strokes == again.strokes
        _require(same, "a plan must depend on the subject and the seed alone")
        targets.add(plan.target.tobytes())
    _require(len(targets) > 0.9 * PLANS, "plans must differ from seed to seed")


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


def check_task(task: Task, behaviour: str = "smooth") -> None:
    """Check a task by playing a lift with it, with a robot and with a second human.

    It must be a frozen dataclass; its first metric is ``rmse_mm``; observations lie within the
    stated bounds; there is one score for each metric, and no NaN where a score is never missing;
    the series it adds have one number per frame; the same actions give the same scores.
    """
    frozen = dataclasses.is_dataclass(task) and type(task).__dataclass_params__.frozen
    _require(frozen, "a task must be a frozen dataclass: its fields are in the digest of suites")
    first = next(iter(task.metrics), None)
    _require(first == LEADING, f"the first metric must be {LEADING}, got {first}")
    for partner in ("nao", "human"):
        scenario = dataclasses.replace(make_scenario(behaviour, "S1", partner), task=task)
        with contextlib.closing(make_lift(scenario)) as lift:
            _check_played(task, lift)


def _check_played(task: Task, lift: Lift) -> None:
    bounds = task.robot_bounds() if lift.seat.is_robot else task.human_bounds(lift.frames_per_step)
    low, high = bounds
    hold = [0.0] * lift.partner_size

    class Watching(Copy):
        """A policy that checks what it is shown."""

        def act(self, observation: NDArray[np.float64]) -> NDArray[np.float64]:
            inside = observation.shape == low.shape and bool(
                ((low <= observation) & (observation <= high)).all()
            )
            _require(inside, f"an observation is outside its bounds: {observation}")
            human, robot = task.rewards(lift) if lift.frame else (0.0, 0.0)
            _require(bool(np.isfinite([human, robot]).all()), "rewards must be finite")
            return super().act(observation) if lift.seat.is_robot else np.array(hold)

    episode = run_episode(lift, Watching(), 0)
    if episode.failure is not None and episode.failure.startswith("step"):
        raise AssertionError(episode.failure)
    _check_scores(task, episode)
    trace = episode.trace
    again = replay(lift, 0, trace.human_action, trace.action, episode.failure)
    _require(repr(again.scores) == repr(episode.scores), "scores must follow from the actions")


def _check_scores(task: Task, episode: Episode) -> None:
    names, scored = list(task.metrics), list(episode.scores)
    _require(names == scored, f"scores must be {', '.join(names)}, got {', '.join(scored)}")
    for metric in task.metrics.values():
        value = episode.scores[metric.name]
        known = metric.missing != "never" or np.isfinite(value)
        _require(bool(known), f"{metric.name} is {value}, but it is stated never to be missing")
    frames = len(episode.trace.human_end)
    for name, series in episode.trace.added.items():
        _require(series.shape == (frames,), f"series {name} must have one number per frame")


def check_suite(suite: Suite) -> None:
    """Check that a suite can be run, published and verified.

    Its name is plain ASCII, scenarios have distinct names, seeds are distinct, and its recipe,
    which goes into result bundles, rebuilds it.
    """
    plain = bool(suite.name) and plain_name(suite.name) == suite.name
    _require(plain, f"the name {suite.name!r} must be plain ASCII")
    names = [scenario.name for scenario in suite.scenarios]
    _require(len(set(names)) == len(names) > 0, "scenarios must have distinct names")
    _require(len(set(suite.seeds)) == len(suite.seeds) > 0, "seeds must be distinct")
    _require(min(suite.seeds) >= 0, "seeds must not be negative")
    _require(
        Recipe.of(suite) is not None,
        "its recipe does not rebuild it: behaviours, subjects and tasks must be registered, with "
        "their default parameters",
    )


def _require(condition: bool, rule: str) -> None:
    if not condition:
        raise AssertionError(rule)


def _observations(seed: int, task: Task) -> NDArray[np.float64]:
    """Return the robot's observations of a lift, (40, 5) or as the task has them."""
    return _made_up(seed) if task == LEVEL else _followed(seed, task)


def _followed(seed: int, task: Task) -> NDArray[np.float64]:
    """Return the observations of a robot that follows the human's end."""
    seen: list[NDArray[np.float64]] = []

    class Noting(Copy):
        """A policy that keeps what it is shown."""

        def act(self, observation: NDArray[np.float64]) -> NDArray[np.float64]:
            seen.append(observation.copy())
            return super().act(observation)

    scenario = dataclasses.replace(make_scenario("smooth", "S1"), task=task)
    with contextlib.closing(make_lift(scenario)) as lift:
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


def _actions(policy: Agent, seen: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a policy's actions in an episode, each checked, shape (n, 1)."""
    policy.reset(3)
    kept = []
    for view in seen:
        action = policy.act(view)
        array = np.asarray(action, dtype=np.float64)
        _require(array.size == 1, f"an action must be one number, got {action!r:.80}")
        _require(bool(np.isfinite(array).all()), f"an action must be finite, got {action!r:.80}")
        kept.append((array, array.copy()))
    _require(
        all(np.array_equal(now, then) for now, then in kept),
        "an action must not change after it was returned",
    )
    return np.array([then.reshape(1) for _, then in kept])
