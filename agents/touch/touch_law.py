"""A recurrent network that moves the hand by sight and touch: inputs, memory and action."""

from collections.abc import Mapping
from enum import IntEnum
from typing import Any, Final, NamedTuple

import numpy as np
from colift.agents.control.portable import ArrayFunctions
from colift.agents.control.recurrent import GatedNetwork, gated
from colift.agents.observations import AgreeObservation, BallObservation, HapticObservation
from colift.agents.touch.touch import FAR_STIFFNESS, TABLE_LENGTH, WRIST_STIFFNESS

AHEAD: Final = 1.2
"""Control periods by which the straight line leads, for the lag of the arm."""

REACH: Final = 0.1
"""Departure from a level table per unit of the network's output [m]."""

TOUCH_INPUTS: Final = 10
"""Number of inputs that all tasks share."""


class TouchNetwork(NamedTuple):
    """A network, and the task for which it was learned."""

    task: str
    network: GatedNetwork


class TouchMemory(NamedTuple):
    """The state between steps; each entry has a last axis of lifts, or none."""

    units: Any
    """(u, ...)"""
    near: Any
    """The last height of the human's end [m]."""
    command: Any
    """The command before the last one [m]."""
    place: Any
    """The last place of the ball [m]; 0 without one."""
    begun: Any
    """1 after the first step, else 0."""


class TaskSenses(NamedTuple):
    """The part of an observation that only one task has, as inputs."""

    observation: type[IntEnum]
    """Layout of the observation."""
    inputs: int
    """Number of inputs that only this task has."""


TASK_SENSES: Final[Mapping[str, TaskSenses]] = {
    "intent": TaskSenses(HapticObservation, 0),
    "agree": TaskSenses(AgreeObservation, 4),
    "ball": TaskSenses(BallObservation, 4),
}


def inputs_of(task: str) -> int:
    """Return the number of a network's inputs in a task."""
    return TOUCH_INPUTS + TASK_SENSES[task].inputs


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
    own, place = _of_task(learned.task, memory, observation)
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
            *own,
        )
    )
    units = gated(network, memory.units, inputs, functions)
    output = functions.product(network.output, functions.join((units, inputs)))
    departure = REACH * (output[0] + network.output_bias[0])
    wanted = near + AHEAD * rise + departure
    begun = memory.begun * 0.0 + 1.0
    return TouchMemory(units, near, command, place, begun), wanted - command


def _of_task(task: str, memory: TouchMemory, observation: Any) -> tuple[tuple[Any, ...], Any]:
    """Return the inputs that only a task has, and the ball's place [m]."""
    if task == "agree":
        hurdle = AgreeObservation
        own = (
            10.0 * observation[hurdle.HURDLE_HEIGHT],
            0.5 * observation[hurdle.HURDLE_START],
            0.5 * observation[hurdle.HURDLE_STOP],
            observation[hurdle.HURDLE_GIVEN],
        )
        return own, memory.place
    if task == "ball":
        place = observation[BallObservation.BALL_PLACE]
        own = (
            5.0 * place,
            50.0 * (place - memory.place) * memory.begun,
            5.0 * observation[BallObservation.TARGET_PLACE],
            observation[BallObservation.TARGET_KNOWN],
        )
        return own, place
    return (), memory.place


def touch_at_rest(network: GatedNetwork) -> TouchMemory:
    """Return the memory at the beginning of a lift."""
    return TouchMemory(np.zeros(network.units), 0.0, 0.0, 0.0, 0.0)
