"""The lifts between two steps, as rules see them."""

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.humans.hand import HandMemory
from colift.agents.rules import Drawn
from colift.benchmark.twin.ball_plant import BallPlant
from colift.benchmark.twin.haptic_plant import HapticPlant
from colift.benchmark.twin.lifts import Lifts
from colift.benchmark.twin.plant import Plant
from colift.benchmark.world.table import WEIGHT_SHARE


class LiftState(NamedTuple):
    """The state of n lifts between two steps; histories are (depth, n), newest first."""

    table: Any
    """A :class:`.Plant`, :class:`.HapticPlant` or :class:`.BallPlant`; or the plant of a pair."""
    command: jax.Array
    """(n,) command of the far hands [m]."""
    hand: HandMemory[jax.Array]
    """The people's hands."""
    memory: Any
    """The people's memory; see :class:`.Person`."""
    intentions: Any
    """Their past intentions: a named tuple of histories."""
    lost: jax.Array
    """(n,) 1 if the lift is lost, else 0."""
    step: jax.Array
    """Number of the coming step: one for all lifts (), or one for each (n,)."""

    @property
    def plant(self) -> Plant:
        """The table without touch and ball."""
        table = self.table.haptic if isinstance(self.table, BallPlant) else self.table
        plant: Plant = table.plant if isinstance(table, HapticPlant) else table
        return plant


class LiftView:
    """The :class:`.View` of n lifts; ``ages`` are those of the motion capture's samples."""

    def __init__(self, state: LiftState, lifts: Lifts, ages: jax.Array) -> None:
        self._state = state
        self.drawn: Drawn[Any] = lifts.drawn
        self.frame = state.step * lifts.frames
        self.visual, self.haptic = lifts.body.seen, lifts.body.felt
        self.latency = ages
        self.hand, self.command = state.plant.hand, state.command

    def seen(self, name: str, age: Any) -> jax.Array:
        """Return a read-out (n,) of some frames ago; see :meth:`.View.seen`."""
        table, plant = self._state.table, self._state.plant
        haptic = table.haptic if isinstance(table, BallPlant) else table
        match name:
            case "human_end":
                return aged(plant.heights, age)
            case "robot_end":
                return aged(plant.heights, age) + aged(plant.differences, age)
            case "human_force":
                return aged(plant.forces, age) + WEIGHT_SHARE
            case "robot_force" if isinstance(haptic, HapticPlant):
                return aged(haptic.touch[::-1, 0], age) + WEIGHT_SHARE
            case "robot_torque" if isinstance(haptic, HapticPlant):
                return aged(haptic.touch[::-1, 1], age)
            case "ball_place" if isinstance(table, BallPlant):
                return aged(table.places, age)
            case "ball_place":
                return 0.0 * self.hand
        return aged(getattr(self._state.intentions, name), age)


def aged(history: jax.Array, age: Any) -> jax.Array:
    """Return the values (n,) of a history, newest first, of an age or of n ages."""
    if isinstance(age, int):
        return history[age]
    ages = jnp.broadcast_to(age, history.shape[1:])
    return jnp.take_along_axis(history, ages[jnp.newaxis], axis=0)[0]
