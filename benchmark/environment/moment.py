"""A moment of an episode, to which an environment can return."""

from collections.abc import Sequence
from typing import NamedTuple

from colift.agents.agent import Agent
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario


class Moment(NamedTuple):
    """A lift, and the actions in it so far, from which all else follows, in any process."""

    scenario: Scenario
    seed: int
    actions: tuple[tuple[list[float], list[float]], ...]
    """The human's and the robot's action in each step."""


def check_same_settings(moment: Moment, scenarios: Sequence[Scenario], *, new_people: bool) -> None:
    """Check that a moment is of an environment with some scenarios.

    Parameters
    ----------
    moment
        The moment.
    scenarios
        All scenarios of the environment, which differ in their behaviour alone.
    new_people
        Whether each lift has a new person.

    Raises
    ------
    InputError
        If it is not; the message names the first difference.
    """
    there = moment.scenario
    same = [each for each in scenarios if each.behaviour == there.behaviour]
    of_moment, here = _settings(there), _settings((same or scenarios)[0])
    if new_people:
        here["subject"] = of_moment["subject"]
    for name, value in here.items():
        if of_moment[name] != value:
            raise InputError(
                f"the moment is of another environment: its {name} is {of_moment[name]!r}, not "
                f"{value!r}"
            )


def _settings(scenario: Scenario) -> dict[str, object]:
    return {
        "task": scenario.task.name,
        "behaviour": scenario.behaviour,
        "subject": scenario.subject.name,
        "partner": scenario.partner,
        "control_period": scenario.control_period,
        "latency": scenario.latency,
    }


def bring_to(lift: Lift, moment: Moment) -> Agent:
    """Bring a lift of the moment's scenario to it, and return its human, who has kept up."""
    lift.reset(moment.seed)
    human = lift.scripted_human()
    for actions in moment.actions:
        human.act(lift.human_observation())
        lift.carry_out(*actions)
    return human
