"""A recurrent network that moves the hand by sight and touch: inputs, memory and action."""

from typing import Any, Final, NamedTuple

import numpy as np
from colift.agents.control.portable import ArrayFunctions
from colift.agents.control.recurrent import GatedNetwork, gated
from colift.agents.senses import Sense
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touched import FAR_STIFFNESS, TABLE_LENGTH, WRIST_STIFFNESS

AHEAD: Final = 1.2
"""Control periods by which the straight line leads, for the lag of the arm."""

REACH: Final = 0.1
"""Departure from a level table per unit of the network's output [m]."""

TOUCH_INPUTS: Final = 10
"""Number of inputs that all tasks share."""


class TouchNetwork(NamedTuple):
    """A network, and the task for which it was learned."""

    task: str
    senses: tuple[Sense, ...]
    """The task's senses besides sight and touch."""
    network: GatedNetwork
    alone: bool = False
    """Whether it acts alone, by :func:`.alone_action`."""

    @property
    def expected(self) -> int:
        """Numbers of the task's observation."""
        return len(HapticObservation) + len(self.senses)


class TouchMemory(NamedTuple):
    """The state between steps; each entry has a last axis of lifts, or none."""

    units: Any
    """(u, ...)"""
    near: Any
    """The last height of the human's end [m]."""
    command: Any
    """The command before the last one [m]."""
    own: tuple[Any, ...]
    """The last numbers of the task's own senses."""
    begun: Any
    """1 after the first step, else 0."""


def inputs_of(senses: tuple[Sense, ...]) -> int:
    """Return the number of a network's inputs in a task with some senses of its own."""
    return TOUCH_INPUTS + sum(sense.inputs for sense in senses)


def felt_action(
    learned: TouchNetwork, memory: TouchMemory, observation: Any, functions: ArrayFunctions
) -> tuple[TouchMemory, Any]:
    """Return the memory after a step, and the change of the command [m].

    With the height z of the human's end, which follows from the torque (:func:`.touched`), and its
    last change d, the next command is

        z + AHEAD d + REACH * network(units, inputs).

    Parameters
    ----------
    learned
        The weights.
    memory
        The memory after the last step.
    observation
        (k, ...) observations of the task's layout.
    functions
        The library of the arrays.
    """
    layout, network = HapticObservation, learned.network
    hand, command = observation[layout.HAND_HEIGHT], observation[layout.HAND_COMMAND]
    force = observation[layout.FORCE]
    pitch = -observation[layout.TORQUE] / FAR_STIFFNESS
    near = hand - TABLE_LENGTH * pitch * (1.0 - pitch * pitch / 6.0)
    wrist = pitch + (FAR_STIFFNESS * pitch - force * TABLE_LENGTH) / WRIST_STIFFNESS
    rise = (near - memory.near) * memory.begun
    own = tuple(observation[len(HapticObservation) + i] for i in range(len(learned.senses)))
    inputs = functions.stack(
        (
            50.0 * rise,
            10.0 * (near - 0.1),
            10.0 * (hand - 0.1),
            50.0 * (command - memory.command) * memory.begun,
            20.0 * (command - hand),
            10.0 * pitch,
            10.0 * wrist,
            2.0 * force,
            10.0 * (observation[layout.HUMAN_END] - 0.1),
            20.0 * (observation[layout.ROBOT_END] - observation[layout.HUMAN_END]),
            *own_inputs(learned.senses, own, memory),
        )
    )
    units = gated(network, memory.units, inputs, functions)
    output = functions.product(network.output, functions.join((units, inputs)))
    departure = REACH * (output[0] + network.output_bias[0])
    wanted = near + AHEAD * rise + departure
    begun = memory.begun * 0.0 + 1.0
    return TouchMemory(units, near, command, own, begun), wanted - command


def own_inputs(senses: tuple[Sense, ...], own: tuple[Any, ...], memory: TouchMemory) -> list[Any]:
    """Return the inputs that only this task has: its senses, and the changes of some."""
    found = []
    for sense, number, last in zip(senses, own, memory.own, strict=True):
        found.append(sense.scale * number)
        if sense.rate:
            found.append(sense.rate * (number - last) * memory.begun)
    return found


def touch_at_rest(learned: TouchNetwork) -> TouchMemory:
    """Return the memory at the beginning of a lift."""
    units = np.zeros(learned.network.units)
    return TouchMemory(units, 0.0, 0.0, (0.0,) * len(learned.senses), 0.0)
