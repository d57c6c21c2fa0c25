"""The lifts of a task with touch between two steps, as rules see them."""

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from colift.agents.humans.hand import HandMemory
from colift.agents.rules import Drawn
from colift.benchmark.twin.ball_plant import BallPlant
from colift.benchmark.twin.haptic_plant import HapticPlant
from colift.benchmark.twin.touch_lifts import TouchLifts
from colift.benchmark.world.table import WEIGHT_SHARE


class TouchState(NamedTuple):
    """The state of n lifts between two steps; histories are (DEPTH, n), newest first."""

    table: BallPlant | HapticPlant
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
    """() number of the coming step."""

    @property
    def haptic(self) -> HapticPlant:
        """The table without a ball."""
        return self.table.haptic if isinstance(self.table, BallPlant) else self.table


class TouchView:
    """The :class:`.View` of n lifts."""

    def __init__(self, state: TouchState, lifts: TouchLifts) -> None:
        self._state = state
        self.drawn: Drawn[Any] = lifts.drawn
        self.frame = state.step * lifts.frames
        self.visual, self.haptic = lifts.body.seen, lifts.body.felt
        self.latency = lifts.latency
        self.hand, self.command = state.haptic.plant.hand, state.command

    def seen(self, name: str, age: Any) -> jax.Array:
        """Return a read-out (n,) of some frames ago; see :meth:`.View.seen`."""
        plant, touch = self._state.haptic.plant, self._state.haptic.touch
        match name:
            case "human_end":
                return aged(plant.heights, age)
            case "robot_end":
                return aged(plant.heights, age) + aged(plant.differences, age)
            case "human_force":
                return aged(plant.forces, age) + WEIGHT_SHARE
            case "robot_force":
                return aged(touch[::-1, 0], age) + WEIGHT_SHARE
            case "robot_torque":
                return aged(touch[::-1, 1], age)
            case "ball_place":
                table = self._state.table
                return aged(table.places, age) if isinstance(table, BallPlant) else 0.0 * self.hand
        return aged(getattr(self._state.intentions, name), age)


def aged(history: jax.Array, age: Any) -> jax.Array:
    """Return the values (n,) of a history, newest first, of an age or of n ages."""
    if isinstance(age, int):
        return history[age]
    # Not a gather: for its gradient, XLA would copy the history for each element.
    picked = (jnp.arange(len(history))[:, jnp.newaxis] == age).astype(history.dtype)
    return jnp.sum(picked * history, axis=0)
