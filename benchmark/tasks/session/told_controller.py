"""A robot that is told the habits of the person: a reference, and no policy."""

from typing import Any

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork, memory_at_rest
from colift.agents.humans import Subject
from colift.agents.sessions.session_controller import act_in_session
from colift.benchmark.tasks.session.telling import habits_told


class ToldSession:
    """The control of a network that is told the habits, and remembers no lift.

    Parameters
    ----------
    network
        The weights, with :data:`.telling.TOLD` more inputs than a policy's.
    subject
        The person.
    """

    def __init__(self, network: GatedNetwork, subject: Subject) -> None:
        self._network, self._subject, self._place = network, subject, -1
        self._told: Any = ()

    def reset(self, seed: int) -> None:
        """Begin the next lift of the session."""
        self._place += 1
        self._told = (np.array(habits_told(self._subject, self._place)),)
        self._memory = memory_at_rest(self._network)

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        view = np.asarray(observation, dtype=np.float64)
        self._memory, change = act_in_session(
            self._network, self._memory, view, PORTABLE, self._told
        )
        return np.array([change])
