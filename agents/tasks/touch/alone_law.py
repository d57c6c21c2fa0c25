"""A recurrent network that acts alone: level by sight, departures by its own knowledge."""

from collections.abc import Callable
from typing import Any, Final

from colift.agents.control.portable import ArrayFunctions
from colift.agents.control.recurrent import gated
from colift.agents.senses import Sense
from colift.agents.tasks.touch.observation import HapticObservation
from colift.agents.tasks.touch.touch_law import (
    REACH,
    TouchMemory,
    TouchNetwork,
    felt_action,
    inputs_of,
    own_inputs,
)

Law = Callable[[TouchNetwork, TouchMemory, Any, ArrayFunctions], tuple[TouchMemory, Any]]

FURTHER: Final = 2.2
"""Control periods by which the line leads: the sample is a latency old, and the arm lags."""

RELUCTANCE: Final = 3.0
"""Number that the third output must exceed for the share to exceed a half."""


def alone_action(
    learned: TouchNetwork, memory: TouchMemory, observation: Any, functions: ArrayFunctions
) -> tuple[TouchMemory, Any]:
    """Return the memory after a step, and the change of the command [m].

    The network's inputs are the time and the task's own senses: no height, force or torque, since
    a hand that keeps level shows where the partner is. With the level L, a straight line through
    the last two seen heights of the human's end, and the outputs d, a and s, the next command is

        (1 - S) (L + REACH d) + S (0.1 + REACH a),  S = 1 / (1 + exp(RELUCTANCE - s)):

    a departure from level, or a height of the robot's own, whatever the partner does.

    Parameters are those of :func:`.felt_action`.
    """
    layout, network = HapticObservation, learned.network
    near = observation[layout.HUMAN_END]
    rise = (near - memory.near) * memory.begun
    own = tuple(observation[len(layout) + i] for i in range(len(learned.senses)))
    time = 0.1 * observation[layout.TIME]
    inputs = functions.stack((time, *own_inputs(learned.senses, own, memory)))
    units = gated(network, memory.units, inputs, functions)
    output = functions.product(network.output, functions.join((units, inputs)))
    departure, height, wish = (output[i] + network.output_bias[i] for i in range(3))
    share = 0.5 + 0.5 * functions.tanh(0.5 * functions.stack((wish - RELUCTANCE,)))[0]
    level = near + FURTHER * rise + REACH * departure
    wanted = (1.0 - share) * level + share * (0.1 + REACH * height)
    command = observation[layout.HAND_COMMAND]
    begun = memory.begun * 0.0 + 1.0
    return TouchMemory(units, near, command, own, begun), wanted - command


def law_of(learned: TouchNetwork) -> Law:
    """Return the equations of a network."""
    return alone_action if learned.alone else felt_action


def ports_of(senses: tuple[Sense, ...], *, alone: bool) -> tuple[int, int]:
    """Return the numbers of inputs and outputs of a network in a task with some senses."""
    if alone:
        return 1 + sum(sense.inputs for sense in senses), 3
    return inputs_of(senses), 1
