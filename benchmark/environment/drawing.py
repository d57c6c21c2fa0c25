"""Lifts to learn from: a person, a behaviour and a seed that are drawn at each reset."""

from dataclasses import dataclass, replace
from typing import Final

from colift.agents.errors import InputError
from colift.agents.humans import Subject
from colift.benchmark.episode.level import LEVEL
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import BEHAVIOURS

TRAINING_SEEDS: Final = range(100_000, 200_000)
"""Seeds of people and lifts to learn from: no suite, calibration or test uses them."""

ANY: Final = "any"
"""The scenario of a behaviour drawn from those of the standard suites."""

DRAW: Final = "draw"
"""The subject of a person drawn from the population of the five subjects."""


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """A source of lifts, each by a seed; behaviours, people and lifts are drawn independently."""

    scenarios: tuple[Scenario, ...]
    """A scenario for each behaviour."""
    new_people: bool
    """Whether each lift has a new person, or that of the scenario."""

    def lift(self, seed: int) -> tuple[Scenario, int]:
        """Return scenario and seed of a lift; pure in ``seed``, which may be any integer."""
        scenario = self.scenarios[derive_seed(seed, "drawn behaviour") % len(self.scenarios)]
        if self.new_people:
            scenario = replace(scenario, subject=Subject.draw(_training_seed(seed, "drawn person")))
        return scenario, _training_seed(seed, "drawn lift")


def _training_seed(seed: int, role: str) -> int:
    return TRAINING_SEEDS[derive_seed(seed, role) % len(TRAINING_SEEDS)]


def make_drawing(
    scenario: str,
    subject: str,
    partner: str,
    control_period: float,
    latency: float,
    task: str = LEVEL.name,
) -> Drawing | None:
    """Return the source of lifts of an environment's settings; None if nothing is to be drawn.

    Parameters
    ----------
    scenario, subject
        As for :func:`.parallel_env`; :data:`ANY` or :data:`DRAW` is drawn.
    partner, control_period, latency, task
        As for :func:`.make_scenario`.

    Raises
    ------
    InputError
        If something is to be drawn for a task other than ``level``, or as :func:`.make_scenario`.
    """
    if scenario != ANY and subject != DRAW:
        return None
    if task != LEVEL.name:
        drawn = f"scenario={ANY!r}" if scenario == ANY else f"subject={DRAW!r}"
        raise InputError(
            f"{drawn} draws lifts of the task {LEVEL.name!r} alone, not of {task!r}: name a "
            "behaviour and a person, such as 'S1' or 'draw-100000'"
        )
    person = f"draw-{TRAINING_SEEDS[0]}" if subject == DRAW else subject
    return Drawing(
        scenarios=tuple(
            make_scenario(behaviour, person, partner, control_period, latency)
            for behaviour in (BEHAVIOURS if scenario == ANY else (scenario,))
        ),
        new_people=subject == DRAW,
    )
