"""The steps of lifts with a ball: sensors, frames, score."""

from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.agent import FRAME, HISTORY
from colift.agents.humans.ball.steering import (
    SQUARE,
    BallTarget,
    SteeringMemory,
    SteeringSenses,
    steer,
)
from colift.agents.humans.hand import HandMemory
from colift.benchmark.episode.metrics import FAILED_FRAME_MM
from colift.benchmark.episode.seat import REFERENCE_RANGE
from colift.benchmark.tasks.ball.lift import STEEPEST_MEANT
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.ball_lifts import BallLifts
from colift.benchmark.twin.ball_plant import BallPlant, advance_ball_plant, ball_plant_at_rest
from colift.benchmark.twin.body import DEPTH, delayed, pushed
from colift.benchmark.twin.columns import filled
from colift.benchmark.twin.functions import LIFTS
from colift.benchmark.twin.haptic_plant import HapticPlant, Meant
from colift.benchmark.twin.haptic_playing import (
    commanded,
    hands_at_rest,
    moved_hand,
    sensed_by_hands,
)
from colift.benchmark.twin.learning_person import Added
from colift.benchmark.twin.lifts import chunk
from colift.benchmark.twin.touch_rollout import TouchSteps, mean_error_mm
from colift.benchmark.world.table import TABLE_LENGTH


class BallState(NamedTuple):
    """The state of n lifts between two steps; histories are (DEPTH, n), newest first."""

    table: BallPlant
    command: jax.Array
    """(n,) command of the far hands [m]."""
    hand: HandMemory[jax.Array]
    """The people's hands."""
    mind: SteeringMemory[jax.Array]
    """The people."""
    plans: jax.Array
    """History of the planned height [m]."""
    targets: jax.Array
    """History of the intended height, with the steering [m]."""
    lost: jax.Array
    """(n,) 1 if the ball has fallen, else 0."""
    step: jax.Array
    """() number of the coming step."""

    @property
    def haptic(self) -> HapticPlant:
        """The table without its ball."""
        return self.table.haptic


def balls_at_rest(count: int) -> BallState:
    """Return lifts at rest."""
    zero, past = jnp.zeros(count), jnp.zeros((DEPTH, count))
    table, mind = ball_plant_at_rest(count), filled(SteeringMemory(0.0, 0.0, 0.0, SQUARE), count)
    number = jnp.zeros((), jnp.int32)
    return BallState(table, zero, hands_at_rest(count), mind, past, past, zero, number)


class BallDue(NamedTuple):
    """A step's share of :class:`.BallLifts`, see there."""

    target: jax.Array
    place: jax.Array
    coming: jax.Array
    gain: jax.Array
    tremor: jax.Array
    noise: jax.Array


def ball_due(lifts: BallLifts) -> BallDue:
    """Return the shares of all steps, with a first axis of steps."""
    return BallDue(lifts.target, lifts.place, lifts.coming, lifts.gain, lifts.tremor, lifts.noise)


def ball_view(state: BallState, lifts: BallLifts, due: BallDue) -> Any:
    """Return the robot's observations (10, n), laid out as :class:`.BallObservation`."""
    time = state.step * len(due.gain) * FRAME
    touch = sensed_by_hands(state.haptic, state.command, time, due.noise[:4], lifts.latency)
    place = delayed(state.table.places[:DEPTH], lifts.latency, 1)[0] + due.noise[4]
    ball = jnp.stack((place, due.coming[0] * lifts.shown, lifts.shown))
    return jnp.concatenate((touch, ball))


def ball_known(state: BallState, lifts: BallLifts, due: BallDue) -> jax.Array:
    """Return the knowledge of n people about the ball (3, n).

    The rows are its seen place, and its intended places now and at the end of ten frames.
    """
    place = delayed(state.table.places[:DEPTH], lifts.body.seen, 1)
    return 5.0 * jnp.concatenate((place, due.coming[jnp.array([0, -1])]))


def steering_senses(state: BallState, lifts: BallLifts, due: BallDue) -> SteeringSenses[jax.Array]:
    """Return what n people perceive, who all know the target."""
    seen, plant, places = lifts.body.seen, state.haptic.plant, state.table.places
    (own,) = delayed(plant.heights, seen, 1)
    # The oldest of the ten places is nine frames older than the newest.
    (newest,), (oldest,) = delayed(places[:DEPTH], seen, 1), delayed(places[HISTORY - 1 :], seen, 1)
    half = (HISTORY - 1) // 2
    return SteeringSenses(
        own=own,
        other=own + delayed(plant.differences, seen, 1)[0],
        planned=delayed(state.plans, seen, 1)[0],
        place=newest,
        speed=(newest - oldest) / (FRAME * (HISTORY - 1)),
        target=BallTarget(due.coming[0], due.coming[half], due.coming[2 * half]),
        span=half * FRAME,
        known=jnp.ones_like(own),
        felt=jnp.zeros_like(own),
    )


def ball_step(
    state: BallState,
    lifts: BallLifts,
    due: BallDue,
    action: jax.Array,
    variation: ArmVariation | None = None,
    added: Added | None = None,
) -> tuple[BallState, jax.Array]:
    """Return the lifts after a step, and the places of the ball in its frames (f, n) [m].

    Parameters
    ----------
    state, lifts
        The lifts.
    due
        The step's share of them.
    action
        (n,) change of the command [m], clipped to the hands' speed and stroke.
    variation
        Variation of the arms; None is the benchmark's arms.
    added
        Additions by learning people; None adds nothing.
    """
    size, body = len(due.gain), lifts.body
    senses = steering_senses(state, lifts, due)
    mind, offsets = steer(LIFTS, lifts.manner, state.mind, senses, -1.0, size)
    targets = due.target + jnp.stack(offsets)
    hand, references = moved_hand(state, targets, body, due)
    differences = due.target - references
    part, limit = lifts.manner.wrist / lifts.manner.share, STEEPEST_MEANT * TABLE_LENGTH
    wrist = jnp.arcsin(jnp.clip(part * differences, -limit, limit) / TABLE_LENGTH)
    if added is not None:
        references, wrist = references + added.height, wrist + added.pitch
    references = jnp.clip(references, *REFERENCE_RANGE)
    commands = commanded(state.command, action, size)

    table, places = state.table, []
    many = chunk(size)
    for first in range(0, size, many):
        frames = slice(first, first + many)
        meant = Meant(references[frames], differences[frames], wrist[frames])
        table = advance_ball_plant(table, body, meant, commands[frames], variation)
        places.append(table.places[:many][::-1])
    place = jnp.concatenate(places)
    fell = (jnp.abs(place).max(axis=0) > TABLE_LENGTH / 2).astype(jnp.float32)
    after = BallState(
        table=table,
        command=commands[-1],
        hand=hand,
        mind=mind,
        plans=pushed(state.plans, due.target),
        targets=pushed(state.targets, targets),
        lost=jnp.maximum(state.lost, fell),
        step=state.step + 1,
    )
    return after, place


def ball_missed(state: BallState, lifts: BallLifts, due: BallDue, places: jax.Array) -> jax.Array:
    """Return the sum of the ball's square distances in a step (n,) [m2].

    A ball that rolls off the table stays where it fell, and each frame of the steps after that
    counts with :data:`.FAILED_FRAME_MM`, as in the engine, so that the loss is finite. Its gradient
    comes only from the frames until then, in which the ball is already farther off than that.
    """
    cut = len(places) * (FAILED_FRAME_MM / 1000) ** 2
    squares = jnp.where(state.lost > 0, cut, ((places - due.place) ** 2).sum(axis=0))
    return squares * (state.step < lifts.steps)


BALL_STEPS: Final = TouchSteps(
    at_rest=balls_at_rest,
    shares=ball_due,
    view=ball_view,
    known=ball_known,
    knows=3,
    step=ball_step,
    missed=ball_missed,
    score_mm=mean_error_mm,
)
"""The steps of the task."""
