"""A Minari data set: HDF5 with an episode for each lift, and the spaces of the environment.

Minari looks for sets below the folder ``MINARI_DATASETS_PATH``, each in a folder of its name with
the files in ``data/``; any other place can be read by ``minari.MinariDataset(folder / "data")``.
"""

import copy
import itertools
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

import gymnasium
import numpy as np
from colift.benchmark.environment.settings import HUMAN, ROBOT
from colift.benchmark.episode.seat import HUMANS
from colift.benchmark.export.library import import_minari
from colift.benchmark.export.lifts import AgentView, ExportedLift, Spaces
from colift.benchmark.export.provenance import Provenance
from gymnasium.spaces import Dict

DATA: Final = "data"
"""The folder of Minari's files in that of a set."""

NAMESPACE: Final = "colift"
"""First part of a set's name in Minari."""

AT_ONCE: Final = 50
"""Lifts that are added at once, since each addition opens the file anew."""

LARGEST_SEED: Final = 2**63
"""Seeds from this value, those of hidden suites, are stored as text: HDF5 has no longer
integers."""


def write_minari(
    folder: Path, lifts: Iterable[ExportedLift], spaces: Spaces, provenance: Provenance
) -> None:
    """Write lifts as a Minari data set into an empty folder.

    With one agent, observations, actions and rewards are the robot's. With both, observations and
    actions are dictionaries with ``human`` and ``robot``, the rewards are the robot's, and the
    human's are ``human_reward`` in the infos, after a 0 for the reset.

    Parameters
    ----------
    folder
        The folder; the files are written to ``data`` in it.
    lifts
        The lifts, in order.
    spaces
        The agents' spaces.
    provenance
        The origin, which goes into the metadata under ``colift``.

    Raises
    ------
    InputError
        If Minari is not installed.
    """
    storage_module = import_minari("dataset.minari_storage")
    buffer_module = import_minari("data_collector.episode_buffer")
    both = provenance.view == "both"
    storage = storage_module.MinariStorage.new(
        (folder / DATA).absolute(),  # Minari fails with a relative path.
        observation_space=Dict({**spaces.observations}) if both else spaces.observations[ROBOT],
        action_space=Dict({**spaces.actions}) if both else spaces.actions[ROBOT],
        env_spec=None if both else _environment(provenance),
    )
    storage.update_metadata(
        {
            "dataset_id": f"{NAMESPACE}/{provenance.name}-v0",
            "minari_version": import_minari().__version__,
            "algorithm_name": provenance.policy,
            "description": f"Cooperative lifts of a human and a robot: {provenance.source}",
            "colift": provenance.plain(),
        }
    )
    written = 0
    remaining = iter(lifts)
    while some := list(itertools.islice(remaining, AT_ONCE)):
        storage.update_episodes(
            [
                buffer_module.EpisodeBuffer(
                    observations=_of_agents(lift, "observations", both),
                    actions=_of_agents(lift, "actions", both),
                    rewards=lift.robot.rewards,
                    terminations=lift.terminations,
                    truncations=lift.truncations,
                    infos=_infos(lift.human),
                )
                for lift in some
            ]
        )
        places = range(written, written + len(some))
        storage.update_episode_metadata([_metadata(lift) for lift in some], places)
        written += len(some)


def _of_agents(lift: ExportedLift, part: str, both: bool) -> Any:
    own = getattr(lift.robot, part)
    return {HUMAN: getattr(lift.human, part), ROBOT: own} if both else own


def _infos(human: AgentView | None) -> dict[str, Any] | None:
    return None if human is None else {"human_reward": np.concatenate(([0.0], human.rewards))}


def _metadata(lift: ExportedLift) -> dict[str, Any]:
    """Return the metadata of a lift: everything from which it can be made again."""
    return {
        "scenario": lift.scenario,
        "behaviour": lift.behaviour,
        "subject": lift.subject,
        "trial": lift.trial,
        "seed": lift.seed if lift.seed < LARGEST_SEED else str(lift.seed),
        "policy": lift.policy,
        "dropped": lift.dropped or "",
        "failure": lift.failure or "",
        "state": lift.state,
    }


def _environment(provenance: Provenance) -> Any:
    """Return the specification of the environment of a robot's view; None if there is none."""
    if provenance.partner in HUMANS:
        return None
    spec = copy.deepcopy(gymnasium.spec("colift/Lift-v0"))
    spec.kwargs = {
        "control_period": provenance.control_period,
        "latency": provenance.latency,
        "task": provenance.task,
        "partner": provenance.partner,
    }
    return spec
