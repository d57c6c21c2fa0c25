"""Proximal policy optimisation on thousands of the twin's lifts at a time, in JAX.

In each update the policy plays whole lifts, with noise on its corrections, and is then moved by
the clipped objective along estimated advantages (J. Schulman et al., "Proximal policy optimization
algorithms", arXiv:1707.06347, and "High-dimensional continuous control using generalized advantage
estimation", ICLR 2016). The network is that of :mod:`.network.policy`: it corrects a straight line
through the human's last heights, so that learning begins with a robot that moves along.
"""

import functools
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from functools import partial
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
import optax

from ...agents.submissions.network.policy import CORRECTION, FIXED, LEAD, Policy, scales
from ..episode.metrics import FAILED_FRAME_MM
from ..episode.scenario import CONTROL_PERIOD
from ..suites.suite import BEHAVIOURS
from ..twin import lifts as twin_lifts
from ..twin import playing as twin
from ..twin.lifts import DrawnLift, Lifts
from ..twin.playing import LiftState
from .course import Course, Point
from .data import Timing, scenario
from .ppo_settings import PpoSettings
from .result import Weights, checked_network, write_policy
from .validation import LEARNING_SEEDS, validation_error

UNIT: Final = 1e-4
"""Mean square height difference that costs 1 [m2]."""

WORST: Final = (FAILED_FRAME_MM / 1000) ** 2
"""Largest square height difference that is paid for [m2]: the twin's table is never dropped."""

LONGEST: Final = 110
"""Steps after which a lift is cut off: nine of ten end before."""

Tree = Any
"""Arrays in named tuples and dictionaries."""


class PastSenses(NamedTuple):
    """The past of n lifts; see :class:`.network.policy.Senses`, of which this is the twin."""

    seen: jax.Array
    """(steps, n) heights of the human's end, newest first [m]."""
    commands: jax.Array
    """(3, n) hand commands, newest first [m]."""


class Experience(NamedTuple):
    """Steps of lifts, each array with the axes (steps, lifts)."""

    inputs: jax.Array
    """(s, n, inputs) scaled."""
    action: jax.Array
    """Corrections before the tanh."""
    log_density: jax.Array
    """Of the action, as it was drawn."""
    value: jax.Array
    """Estimated sum of the rewards to come."""
    reward: jax.Array
    """Minus the mean square height difference over the step [cm2]."""
    valid: jax.Array
    """1 until the lift's horizon, then 0."""


def train_ppo(
    settings: PpoSettings,
    course: Course,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda updates: None,
) -> None:
    """Train a policy and write it into the folder of the course; resume it if it was interrupted.

    The points of the curve are errors in the engine, not in the twin.

    Parameters
    ----------
    settings, course
        What is trained, and where it is written.
    executor
        Draws the lifts and plays those of the curve; none: in this process.
    progress
        Called with the number of updates that were finished since the last call.

    Raises
    ------
    InputError
        If the course cannot be resumed, or a file cannot be written.
    """
    begin = time.perf_counter()
    parameters = start(settings, course.seed)
    learning = parameters, _optimiser(settings).init(parameters)
    leaves, structure = jax.tree.flatten(learning)
    shapes = {f"leaf{i}": np.shape(leaf) for i, leaf in enumerate(leaves)}
    state, first = course.load({**shapes, "update": ()}), 0
    if state is not None:
        leaves = [jnp.asarray(state[name]) for name in shapes]
        learning, first = jax.tree.unflatten(structure, leaves), int(state["update"])
        progress(first)
    begin -= course.seconds
    steps = course.steps
    pool = draw_pool_of(settings, course.seed, executor)
    update = _compiled(settings)
    every = max(settings.updates // 20, 1)
    for number in range(first, settings.updates):
        key = jax.random.fold_in(jax.random.key(course.seed), number)
        learning, played = update(learning, pool, key)
        steps += int(played)
        progress(1)
        if (number + 1) % every == 0 or number + 1 == settings.updates:
            leaves = [np.asarray(leaf) for leaf in jax.tree.leaves(learning)]
            kept = dict(zip(shapes, leaves, strict=True))
            network = checked_network(weights(learning[0]))
            error = validation_error(partial(Policy, network), executor)
            point = Point(steps, time.perf_counter() - begin, error)
            course.keep(point, {**kept, "update": np.array(number + 1)})
    write_policy(
        course,
        weights(learning[0]),
        description=f"A straight line through the human's last heights, corrected by a network of "
        f"2 x {settings.hidden} units, trained by proximal policy optimisation.",
        trained_on=f"{settings.pool} lifts of colift's twin with drawn people, seeds "
        f"{LEARNING_SEEDS[0]} to {LEARNING_SEEDS[-1]}.",
    )


def draw_pool_of(settings: PpoSettings, seed: int, executor: Executor | None = None) -> Lifts:
    """Return the pool of lifts of a training: all behaviours, a new person in each."""
    rng = np.random.default_rng([seed, 1])
    chosen = rng.choice(LEARNING_SEEDS, settings.pool, replace=False).tolist()
    drawn: Iterator[DrawnLift] = map(drawn_lift, chosen)
    if executor is not None:
        drawn = executor.map(drawn_lift, chosen, chunksize=32)
    return twin_lifts.stack(list(drawn))


def drawn_lift(seed: int) -> DrawnLift:
    """Return the lift of a seed and its person, the beginning if it is long."""
    lift = twin_lifts.carried_out(scenario(seed, BEHAVIOURS, Timing()), seed)
    return lift._replace(
        reference=lift.reference[:LONGEST], target=lift.target[:LONGEST], noise=lift.noise[:LONGEST]
    )


def start(settings: PpoSettings, seed: int) -> Tree:
    """Return the first parameters: no correction on average, and no idea of a value."""
    keys = jax.random.split(jax.random.fold_in(jax.random.key(seed), 10**6), 6)
    inputs, hidden = FIXED + settings.steps, settings.hidden
    layer = jax.nn.initializers.orthogonal(2**0.5)

    def network(keys: jax.Array, last: float) -> Tree:
        out = jax.nn.initializers.orthogonal(last)
        return {
            "w0": layer(keys[0], (hidden, inputs)),
            "b0": jnp.zeros(hidden),
            "w1": layer(keys[1], (hidden, hidden)),
            "b1": jnp.zeros(hidden),
            "w2": out(keys[2], (1, hidden)),
            "b2": jnp.zeros(1),
            "linear": jnp.zeros(inputs),
        }

    return {
        "policy": network(keys[:3], 0.01),
        "value": network(keys[3:], 1.0),
        "log_noise": jnp.log(jnp.asarray(settings.noise)),
    }


def weights(parameters: Tree) -> Weights:
    """Return the weights of the policy that is shipped."""
    return {name: np.asarray(value, np.float64) for name, value in parameters["policy"].items()}


def output(network: Tree, inputs: jax.Array) -> jax.Array:
    """Return the output (...) of a network for inputs (..., k)."""
    hidden = jnp.tanh(inputs @ network["w0"].T + network["b0"])
    hidden = jnp.tanh(hidden @ network["w1"].T + network["b1"])
    outputs = hidden @ network["w2"].T + network["b2"]
    found: jax.Array = outputs[..., 0] + inputs @ network["linear"]
    return found


def sense(senses: PastSenses, view: jax.Array, first: jax.Array) -> tuple[PastSenses, jax.Array]:
    """Return the past after one more observation, and the inputs [m].

    Parameters
    ----------
    senses
        The past.
    view
        (5, n) observations of the robot.
    first
        Whether it is the first one of the lifts: before it, everything stood still.

    Returns
    -------
    tuple
        The past, and the inputs (n, 7 + steps).
    """
    human, end, hand, command, _ = view
    seen = jnp.where(first, human, senses.seen)
    commands = jnp.where(first, command, senses.commands)
    seen, commands = jnp.vstack((human, seen)), jnp.vstack((command, commands))
    now = jnp.stack((human, command - human, hand - command, end - human))
    inputs = jnp.concatenate((now, commands[:-1] - commands[1:], seen[:-1] - seen[1:]))
    return PastSenses(seen[:-1], commands[:-1]), inputs.T


def collect(settings: PpoSettings, parameters: Tree, lifts: Lifts, key: jax.Array) -> Experience:
    """Return whole lifts with a policy whose corrections are noisy."""
    divisor = jnp.asarray(scales(settings.steps), jnp.float32)
    noise = jnp.exp(parameters["log_noise"])

    def step(
        state: tuple[LiftState, PastSenses], now: tuple[twin.Due, jax.Array]
    ) -> tuple[tuple[LiftState, PastSenses], Experience]:
        playing, senses = state
        due, drawn = now
        view = twin.observe(playing, due.noise, lifts.latency, CONTROL_PERIOD)
        senses, metres = sense(senses, view, playing.step == 0)
        inputs = metres / divisor
        action = output(parameters["policy"], inputs) + noise * drawn
        line = LEAD * metres[:, FIXED] - metres[:, 1]
        valid = (playing.step < lifts.steps).astype(jnp.float32)
        change = line + CORRECTION * jnp.tanh(action)
        playing, frames = twin.control_step(playing, lifts.body, due, change)
        square = jnp.minimum((frames.human_end - frames.robot_end) ** 2, WORST).mean(axis=0)
        played = Experience(
            inputs=inputs,
            action=action,
            log_density=_log_density(drawn, parameters["log_noise"]),
            value=output(parameters["value"], inputs),
            reward=-square / UNIT,
            valid=valid,
        )
        return (playing, senses), played

    count, longest = lifts.size, lifts.longest()
    rest = PastSenses(jnp.zeros((settings.steps, count)), jnp.zeros((3, count)))
    shares = twin.Due(lifts.reference, lifts.seen_target, lifts.noise)
    drawn = jax.random.normal(key, (longest, count))
    _, played = jax.lax.scan(step, (twin.lifts_at_rest(lifts), rest), (shares, drawn))
    return played


def advantages(settings: PpoSettings, played: Experience) -> jax.Array:
    """Return the generalised estimate of each action's advantage (s, n); 0 after the horizon."""

    def back(
        after: tuple[jax.Array, jax.Array], now: tuple[jax.Array, ...]
    ) -> tuple[tuple[jax.Array, jax.Array], jax.Array]:
        coming, next_value = after
        reward, value, valid = now
        surprise = reward + settings.discount * next_value - value
        advantage = valid * (surprise + settings.discount * settings.trace * coming)
        return (advantage, valid * value), advantage

    zero = jnp.zeros(played.value.shape[1])
    steps = (played.reward, played.value, played.valid)
    return jax.lax.scan(back, (zero, zero), steps, reverse=True)[1]


def objective(
    settings: PpoSettings,
    parameters: Tree,
    played: Experience,
    advantage: jax.Array,
    aim: jax.Array,
) -> jax.Array:
    """Return the clipped objective with the error of the values, to be minimised."""
    drawn = played.action - output(parameters["policy"], played.inputs)
    drawn = drawn / jnp.exp(parameters["log_noise"])
    ratio = jnp.exp(_log_density(drawn, parameters["log_noise"]) - played.log_density)
    clipped = jnp.clip(ratio, 1 - settings.clip, 1 + settings.clip)
    gain = jnp.minimum(ratio * advantage, clipped * advantage)
    miss = (output(parameters["value"], played.inputs) - aim) ** 2
    return ((0.5 * 0.1 * miss - gain) * played.valid).sum() / played.valid.sum()


def _log_density(drawn: jax.Array, log_noise: jax.Array) -> jax.Array:
    """Return the logarithm of a normal density, up to a constant; ``drawn`` is standardised."""
    return -0.5 * drawn**2 - log_noise


@functools.cache
def _compiled(settings: PpoSettings) -> Callable[..., tuple[tuple[Tree, Tree], jax.Array]]:
    """Return the update, compiled once for all seeds."""
    return jax.jit(partial(_update, settings, _optimiser(settings)))


def _update(
    settings: PpoSettings,
    optimiser: optax.GradientTransformation,
    learning: tuple[Tree, Tree],
    pool: Lifts,
    key: jax.Array,
) -> tuple[tuple[Tree, Tree], jax.Array]:
    """Return parameters and optimiser after one update, and the steps that were played."""
    choice, noise, order = jax.random.split(key, 3)
    chosen = jax.random.choice(choice, settings.pool, (settings.lifts,), replace=False)
    played = collect(settings, learning[0], twin_lifts.some(pool, chosen), noise)
    advantage = advantages(settings, played)
    aim = advantage + played.value
    total = played.valid.sum()
    mean = (advantage * played.valid).sum() / total
    spread = jnp.sqrt((((advantage - mean) ** 2) * played.valid).sum() / total)
    advantage = (advantage - mean) / (spread + 1e-8)
    samples = (played, advantage, aim)
    size = advantage.size // settings.batches
    flat = jax.tree.map(lambda array: array.reshape(-1, *array.shape[2:]), samples)

    def learn(learning: tuple[Tree, Tree], chosen: jax.Array) -> tuple[tuple[Tree, Tree], None]:
        parameters, memory = learning
        batch = jax.tree.map(lambda array: array[chosen], flat)
        slope = jax.grad(partial(objective, settings))(parameters, *batch)
        changes, memory = optimiser.update(slope, memory, parameters)
        return (optax.apply_updates(parameters, changes), memory), None

    def epoch(learning: tuple[Tree, Tree], key: jax.Array) -> tuple[tuple[Tree, Tree], None]:
        shuffled = jax.random.permutation(key, advantage.size)[: size * settings.batches]
        return jax.lax.scan(learn, learning, shuffled.reshape(settings.batches, size))[0], None

    learning, _ = jax.lax.scan(epoch, learning, jax.random.split(order, settings.epochs))
    return learning, total


def _optimiser(settings: PpoSettings) -> optax.GradientTransformation:
    falling = optax.linear_schedule(
        settings.rate, 0.0, settings.updates * settings.epochs * settings.batches
    )
    return optax.chain(optax.clip_by_global_norm(0.5), optax.adam(falling))
