"""A moment of an episode, to which an environment can return."""

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


def check_same_settings(moment: Moment, scenario: Scenario) -> None:
    """Check that a moment is of an environment with the settings of a scenario.

    Raises
    ------
    InputError
        If it is not; the message names the first difference.
    """
    of_moment, here = _settings(moment.scenario), _settings(scenario)
    for name, value in here.items():
        if of_moment[name] != value:
            raise InputError(
                f"the moment is of another environment: its {name} is {of_moment[name]!r}, not "
                f"{value!r}"
            )


def _settings(scenario: Scenario) -> dict[str, object]:
    return {
        "task": scenario.task.name,
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
