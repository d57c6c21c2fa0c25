"""Lifts to learn from: a person, a behaviour and a seed that are drawn at each reset."""

from dataclasses import dataclass, replace
from typing import Final

from colift.agents.humans import Subject
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.suites.catalogue import TASK, make_scenario, make_task
from colift.benchmark.suites.ranges import TRAINING_PEOPLE

TRAINING_SEEDS: Final = TRAINING_PEOPLE
"""Seeds of people and lifts to learn from: no suite, calibration or test uses them."""

ANY: Final = "any"
"""A behaviour drawn from those of the task."""

DRAW: Final = "draw"
"""A person drawn from the population of the five subjects."""


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
    behaviour: str,
    subject: str,
    partner: str,
    control_period: float,
    latency: float,
    task: str = TASK,
) -> Drawing | None:
    """Return the source of lifts of an environment's settings; None if nothing is to be drawn.

    Parameters
    ----------
    behaviour, subject
        As for :func:`.parallel_env`; :data:`ANY` or :data:`DRAW` is drawn.
    partner, control_period, latency, task
        As for :func:`.make_scenario`.

    Raises
    ------
    InputError
        As :func:`.make_scenario`.
    """
    if behaviour != ANY and subject != DRAW:
        return None
    person = f"draw-{TRAINING_SEEDS[0]}" if subject == DRAW else subject
    return Drawing(
        scenarios=tuple(
            make_scenario(each, person, partner, control_period, latency, task)
            for each in (make_task(task).behaviours if behaviour == ANY else (behaviour,))
        ),
        new_people=subject == DRAW,
    )
