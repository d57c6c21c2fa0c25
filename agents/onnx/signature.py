"""The signature of a network: which input is the observation, which output the action.

Names decide where they tell (:mod:`.names`). Otherwise shapes do: a state has the same shape and
type before a step and after it, the observation and the action do not. What neither decides is
refused, because a network with exchanged inputs runs, and acts wrongly.
"""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from colift.agents.agent import RobotObservation
from colift.agents.onnx.allowed import MOST_OBSERVATION, MOST_STATE
from colift.agents.onnx.names import ACTION, OBSERVATION, candidates, paired
from colift.agents.onnx.ports import Port, listed, quoted
from colift.base.errors import InputError

ACTIONS: Final = ((), (1,), (1, 1))
"""Shapes of the action."""


@dataclass(frozen=True, kw_only=True)
class State:
    """A state of a network: an input, and the output from which it follows."""

    before: Port
    after: Port


@dataclass(frozen=True, kw_only=True)
class Signature:
    """What the inputs and outputs of a network are."""

    observation: Port
    action: Port
    states: tuple[State, ...]
    """Its states, in the order of the inputs."""


def signature_of(inputs: Sequence[Port], outputs: Sequence[Port]) -> Signature:
    """Return which of at least one input is the observation, which output the action, the states.

    Raises
    ------
    InputError
        If their numbers do not fit, a shape is not that of its role, there are too many numbers in
        the states, or neither names nor shapes tell the roles.
    """
    for ports in (inputs, outputs):
        if len({each.name for each in ports}) < len(ports):
            raise InputError(f"has a name twice among {listed(ports)}")
    if len(inputs) != len(outputs):
        due = "the action alone"
        if len(inputs) > 1:
            due = "the action and the new state of each state"
        raise InputError(
            f"has the outputs {listed(outputs)}; with its inputs ({listed(inputs)}) it must have "
            f"{due}"
        )
    observation, action = _observation_and_action(inputs, outputs)
    _check_roles(observation, action)
    before = [each for each in inputs if each != observation]
    after = [each for each in outputs if each != action]
    return Signature(observation=observation, action=action, states=_states(before, after))


def _observation_and_action(inputs: Sequence[Port], outputs: Sequence[Port]) -> tuple[Port, Port]:
    """Return the only input and output that can be them; any, if none can."""
    seen = candidates([each.name for each in inputs], OBSERVATION)
    done = candidates([each.name for each in outputs], ACTION)
    fitting: list[tuple[Port, Port]] = []
    for named in zip(seen, done, strict=True):
        fitting = [
            (observation, action)
            for observation in inputs
            for action in outputs
            if observation.name in named[0] and action.name in named[1]
            if _fits(observation, action, inputs, outputs)
        ]
        if len(fitting) == 1:
            return fitting[0]
    if not fitting:  # The checks of what names tell, or places, say why.
        first, last = seen[0] or seen[1], done[0] or done[1]
        return (
            next(each for each in inputs if each.name == first[0]),
            next(each for each in outputs if each.name == last[0]),
        )
    sides = [dict.fromkeys(each.name for each in side) for side in zip(*fitting, strict=True)]
    names, role = (sides[0], "observation") if len(sides[0]) > 1 else (sides[1], "action")
    raise InputError(
        f"has {' and '.join(map(quoted, names))}, of which neither names nor shapes tell the "
        f"{role}: name it {role!r} in the export"
    )


def _fits(observation: Port, action: Port, inputs: Sequence[Port], outputs: Sequence[Port]) -> bool:
    """Return whether two can be observation and action, and the rest states."""
    before = Counter(each.form for each in inputs if each != observation)
    after = Counter(each.form for each in outputs if each != action)
    return before == after and _is_observation(observation) and action.shape in ACTIONS


def _is_observation(port: Port) -> bool:
    size = port.shape[-1] if port.shape else 0
    return port.shape in ((size,), (1, size)) and len(RobotObservation) <= size <= MOST_OBSERVATION


def _check_roles(observation: Port, action: Port) -> None:
    least = len(RobotObservation)
    if not _is_observation(observation):
        raise InputError(
            f"has the observation {quoted(observation.name)} with the shape "
            f"{list(observation.shape)}; it must be [n] or [1, n], with n = {least} for a level "
            f"table, and {least} to {MOST_OBSERVATION} for other tasks and views"
        )
    if action.shape not in ACTIONS:
        raise InputError(
            f"has the action {quoted(action.name)} with the shape {list(action.shape)}; it must be "
            "[1]"
        )


def _states(before: Sequence[Port], after: Sequence[Port]) -> tuple[State, ...]:
    """Return the states, each with the output that has its name, or else its shape."""
    new = {each.name: each for each in after}
    if len(before) == 1:
        pairs: dict[str, str] | None = {before[0].name: after[0].name}
    else:
        pairs = paired([each.name for each in before], list(new)) or _of_equal_forms(before, after)
    if pairs is None:
        raise InputError(
            f"has the states {listed(before)} and the new states {listed(after)}, of which neither "
            "names nor shapes tell which belong together: name the new one of 'h' 'new_h' in the "
            "export"
        )
    states = tuple(State(before=each, after=new[pairs[each.name]]) for each in before)
    for state in states:
        if state.before.form != state.after.form:
            raise InputError(
                f"has the new state {quoted(state.after.name)} with another shape or type than the "
                f"state {quoted(state.before.name)}, {list(state.before.shape)}"
            )
    if sum(math.prod(each.shape) for each in before) > MOST_STATE:
        shown = ", ".join(f"{quoted(one.name)} with the shape {list(one.shape)}" for one in before)
        raise InputError(f"has the state {shown[:200]}; at most {MOST_STATE} numbers are allowed")
    return states


def _of_equal_forms(before: Sequence[Port], after: Sequence[Port]) -> dict[str, str] | None:
    """Return the name after a step of each state, if all states differ in shape or type."""
    forms = {each.form: each.name for each in after}
    if len(forms) < len(after) or {each.form for each in before} != forms.keys():
        return None
    return {each.name: forms[each.form] for each in before}
