"""The baselines of every result: the human-human baseline, and the policies hold and copy.

For the public suites the baselines are shipped, together with the references
(:mod:`.references`), which take minutes to play; for any other set of episodes the baselines are
played.
"""

import functools
import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Final, Protocol, runtime_checkable

from colift.agents.agent import Agent
from colift.agents.humans import SecondPerson
from colift.agents.loading.policy_spec import InMemorySpec, PolicySpec
from colift.agents.spec import AgentSpec
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.runner import Run, finished, run_suite
from colift.benchmark.rendering.style import PEOPLE
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite

HUMAN_HUMAN: Final = "human_human"
"""Key of the human-human baseline."""

HUMAN_HUMAN_LABEL: Final = PEOPLE
"""Its name in tables and pictures."""

BEST_KNOWN: Final = "best_known"
"""Key of the trained reference."""


def reference_label(name: str) -> str:
    """Return the name of a reference in tables and pictures."""
    return "best known (trained)" if name == BEST_KNOWN else name.replace("_", " ")


SECOND_PERSON_SPEC: Final = InMemorySpec(
    name=HUMAN_HUMAN, factory=SecondPerson, source=SecondPerson
)
"""The partner: the second human of the human-human baseline."""


@runtime_checkable
class Accompanied(Protocol):
    """A behaviour or a task with its own agent for the second human."""

    @property
    def second_human(self) -> type[Agent]:
        """Class of the agent, made without arguments."""


def partner_spec(scenario: Scenario) -> AgentSpec:
    """Return the second human beside the person of a scenario."""
    for each in (scenario.human, scenario.task):
        if isinstance(each, Accompanied):
            made = each.second_human
            return InMemorySpec(name=HUMAN_HUMAN, factory=made, source=made)
    return SECOND_PERSON_SPEC


BASELINES: Final = (HUMAN_HUMAN, "hold", "copy")
"""The names of the baselines."""


def baseline_specs(suite: Suite) -> dict[str, AgentSpec]:
    """Return the agents that play a suite's baselines, by the baselines' names."""
    human = partner_spec(suite.scenarios[0])
    return {name: human if name == HUMAN_HUMAN else PolicySpec(text=name) for name in BASELINES}


_MOST_PLAYED: Final = 16
"""Suites whose baselines a process remembers."""

_played: Final[dict[str, dict[str, ScoreTable]]] = {}
"""Baselines that this process has played, by the digest of the suite."""


def human_human_run(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Run:
    """Play a suite's episodes with a second human at the robot's end; see :func:`.run_suite`."""
    spec = partner_spec(suite.scenarios[0])
    return run_suite(spec, suite.with_partner("human"), executor=executor, progress=progress)


def play_baselines(
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> dict[str, ScoreTable]:
    """Play the baselines on a suite's episodes; arguments as for :func:`.run_suite`.

    A process plays the baselines of a suite only once, since the suite's digest covers all that
    could change them.
    """
    known = _played.get(suite.digest)
    if known is not None:
        progress(suite.size * len(known))
        return dict(known)
    found = {}
    for name, spec in baseline_specs(suite).items():
        played = suite.with_partner("human") if name == HUMAN_HUMAN else suite
        lifts = finished(spec, played, executor=executor, progress=progress)
        found[name] = ScoreTable.of_lifts(suite, lifts).stored()
    while len(_played) >= _MOST_PLAYED:
        del _played[next(iter(_played))]
    _played[suite.digest] = dict(found)
    return found


def shipped_baselines(suite: Suite) -> dict[str, ScoreTable] | None:
    """Return the shipped baselines of a suite, or None if there are none for its digest."""
    return _shipped(suite, "baselines")


def shipped_references(suite: Suite) -> dict[str, ScoreTable] | None:
    """Return the shipped references of a suite, or None if there are none for its digest."""
    return _shipped(suite, "references")


@functools.cache
def shipped_content() -> dict[str, Any]:
    """Return the content of the shipped file, by suite digest; see :func:`baselines_json`."""
    path = files(__package__).joinpath("data", "baselines.json")
    found: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
    return found


def _shipped(suite: Suite, kind: str) -> dict[str, ScoreTable] | None:
    content = shipped_content().get(suite.digest)
    if content is None:
        return None
    return {name: ScoreTable.read(value) for name, value in content[kind].items()}


@dataclass(frozen=True, kw_only=True)
class ToShip:
    """The shipped results of a suite."""

    suite: Suite
    baselines: Mapping[str, ScoreTable]
    references: Mapping[str, ScoreTable]


def baselines_json(played: Sequence[ToShip], kept: Mapping[str, Any] | None = None) -> str:
    """Return the content of the shipped file: baselines and references by suite digest.

    Suites are in the order of their names.

    Parameters
    ----------
    played
        The suites, with the baselines and references that have been played.
    kept
        Content of a file whose entries are kept, except those of the suites that have been played.
    """
    names = {each.suite.name for each in played}
    others = {key: each for key, each in (kept or {}).items() if each["suite"] not in names}
    content = others | {
        each.suite.digest: {
            "suite": each.suite.name,
            "baselines": {name: value.plain() for name, value in each.baselines.items()},
            "references": {name: value.plain() for name, value in each.references.items()},
        }
        for each in played
    }
    in_order = dict(sorted(content.items(), key=lambda entry: str(entry[1]["suite"])))
    return json.dumps(in_order, indent=1) + "\n"
