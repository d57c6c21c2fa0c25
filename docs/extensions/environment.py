"""Directives about the environment, answered by the environment itself.

``environment`` is the table of its agents and spaces; ``observation AGENT`` the index table of an
agent's observation, with the names, meanings and units of the index class and the bounds of the
space; ``senses TASK`` the robot's observation and action in a task; ``arguments MODULE:FUNCTION``
the table of a function's arguments.
"""

import inspect
import re
from importlib import import_module
from typing import Any, Final

import colift
import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import HumanObservation, RobotObservation
from colift.agents.senses import SIGHT, TOUCH
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.suites.catalogue import make_task
from docutils import nodes
from gymnasium.spaces import Box
from markdown_text import attribute_docs, from_docstring, table
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

INDICES: Final = {"robot": RobotObservation, "human": HumanObservation}

ARGUMENT: Final = re.compile(r"^(\w+)\n((?:    .*\n?)+)", re.MULTILINE)
"""A parameter in a docstring, and its meaning."""

UNIT: Final = re.compile(r" \[([^\]]*)\]")


class Environment(SphinxDirective):
    """The agents of ``colift.parallel_env`` with its default settings, and their spaces."""

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        env = colift.parallel_env()
        names = ", ".join(f"`{name}`" for name in env.possible_agents)
        rows = [
            ("Import", "`from colift import colift_v0`, or `colift.parallel_env` and `colift.env`"),
            ("Agents", names),
            ("Parallel API", "yes: `parallel_env()`; in turns: `env()`; the robot alone: `make()`"),
            *(
                (f"{kind} of `{name}`", _box(space(name)))
                for kind, space in (
                    ("Actions", env.action_space),
                    ("Observations", env.observation_space),
                )
                for name in env.possible_agents
            ),
            ("Render modes", ", ".join(f"`{mode}`" for mode in env.metadata["render_modes"])),
        ]
        env.close()
        return self.parse_text_to_nodes(table(("", "`colift_v0`"), rows))


class ObservationTable(SphinxDirective):
    """The index table of an agent's observation."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        agent = self.arguments[0]
        indices = INDICES[agent]
        env = colift.parallel_env()
        space = env.observation_space(agent)
        env.close()
        assert isinstance(space, Box)
        rows = [
            self._row(getattr(indices, name), name, meaning, space)
            for name, meaning in attribute_docs(indices).items()
        ]
        head = ("Index", f"`{indices.__name__}`", "Meaning", "Unit", "Range")
        return self.parse_text_to_nodes(table(head, rows))

    def _row(self, place: int | slice, name: str, meaning: str, space: Box) -> tuple[str, ...]:
        """Return the row of one number, or of several in a row."""
        count = space.shape[0]
        at = np.arange(count)[place] if isinstance(place, slice) else np.array([place % count])
        unit = UNIT.search(meaning)
        if unit is None:
            raise self.severe(f"{name} of {self.arguments[0]} has no unit")
        index = f"{at[0]}" if len(at) == 1 else f"{at[0]} to {at[-1]}"
        low, high = (np.unique(bound[at]) for bound in (space.low, space.high))
        if len(low) != 1 or len(high) != 1:
            raise self.severe(f"{name} of {self.arguments[0]} has numbers with different bounds")
        return index, f"`{name}`", UNIT.sub("", meaning), unit[1], _range(low[0], high[0])


class Senses(SphinxDirective):
    """The robot's observation in a task, number by number, and its action."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        task = make_task(self.arguments[0])
        every = (*SIGHT, *(TOUCH if task.touch else ()), *task.senses)
        rows = [
            (f"{place}&nbsp;`{each.name.upper()}`", each.meaning, f"{each.noise:g}")
            for place, each in enumerate(every)
        ]
        most = action_limit(CONTROL_PERIOD)
        change = f"change of the hand's command [m], within {_range(-most, most)}"
        head = ("Observation", "Meaning", "Noise")
        return self.parse_text_to_nodes(table(head, [*rows, ("**Action**", change, "")]))


class Arguments(SphinxDirective):
    """The arguments of a function: defaults from its signature, meanings from its docstring."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        module, _, name = self.arguments[0].partition(":")
        function = getattr(import_module(module), name)
        meanings = dict(ARGUMENT.findall(inspect.getdoc(function) or ""))
        rows = [
            (f"`{each}`", f"`{parameter.default!r}`", from_docstring(meanings[each]))
            for each, parameter in inspect.signature(function).parameters.items()
        ]
        return self.parse_text_to_nodes(table(("Argument", "Default", "Meaning"), rows))


def _box(space: Any) -> str:
    """Return shape, type and bounds of a space."""
    low, high = np.unique(space.low), np.unique(space.high)
    bounds = f", in {_range(low[0], high[0])}" if len(low) == len(high) == 1 else ", bounds below"
    return f"`{space.shape}`, {space.dtype}{bounds}"


def _range(low: float, high: float) -> str:
    return f"[{low:g}, {high:g}]"


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives."""
    app.add_directive("arguments", Arguments)
    app.add_directive("environment", Environment)
    app.add_directive("observation", ObservationTable)
    app.add_directive("senses", Senses)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
