"""The ghost of a replay: the human-human team in the very same episode."""

import contextlib
import dataclasses
from dataclasses import dataclass

from ...agents.humans import Plan
from ...benchmark.episode import Episode, run_episode
from ...benchmark.lift import Lift
from ...benchmark.references import HumanTeam
from ...benchmark.scenario import Scenario


@dataclass(frozen=True, kw_only=True, eq=False)
class Ghost:
    """How two people do it, and what the first of them means to do."""

    episode: Episode
    plan: Plan
    """The same for every partner: it follows from scenario and seed."""
    horizon: int
    """Frames of the whole episode."""


def play_ghost(scenario: Scenario, seed: int) -> Ghost:
    """Play an episode with a second human at the robot's end; about 0.1 s."""
    with contextlib.closing(Lift(dataclasses.replace(scenario, partner="human"))) as lift:
        episode = run_episode(lift, HumanTeam().make(), seed)
        return Ghost(episode=episode, plan=lift.plan, horizon=lift.horizon)
