"""The actions of a second person in a live lift, derived from the samples of the hand."""

import numpy as np
from colift.agents.agent import Agent, HumanObservation, RobotObservation
from colift.agents.humans import PersonAsRobot, Played, PlayedHand
from colift.agents.humans.hand_log import HandLog, LoggedHand
from colift.benchmark.episode.scenario import Scenario
from numpy.typing import NDArray


def far_person(scenario: Scenario, log: HandLog) -> Agent:
    """Return the second person of a live lift as an agent, from the samples of the hand."""
    if scenario.seat.is_robot:
        hand = LoggedHand(log)
        return PersonAsRobot(hand, scenario.frames_per_step, scenario.control_period)
    return PlayedHand(log)


def far_actions(scenario: Scenario, steps: int) -> NDArray[np.float64] | None:
    """Return the actions at the far end that follow from the hand of a second person.

    Parameters
    ----------
    scenario
        The scenario of a live lift.
    steps
        Number of steps that were made.

    Returns
    -------
    ndarray or None
        Actions [m], one row per step; None if no second person held the far end.
    """
    human = scenario.human
    if not isinstance(human, Played) or human.far is None:
        return None
    frames, person = scenario.frames_per_step, far_person(scenario, human.far)
    person.reset(0)
    if not scenario.seat.is_robot:
        nothing = np.zeros(HumanObservation.size(frames))
        return np.array([person.act(nothing) for _ in range(steps)]).reshape(steps, frames)
    period, found = scenario.control_period, np.empty((steps, 1))
    seen = np.zeros(len(RobotObservation))
    for step in range(steps):
        found[step] = person.act(seen)
        command = float(seen[RobotObservation.HAND_COMMAND])
        change = scenario.seat.reached(command, float(found[step, 0]), period) - command
        # This gives the bits of the last command of the seat's ramp.
        seen[RobotObservation.HAND_COMMAND] = command + change * frames / frames
    return found
