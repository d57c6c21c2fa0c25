"""Networks that are told more than a policy, and their files."""

import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import numpy as np
from colift.agents.control.recurrent import INPUTS, GatedNetwork, network_of
from colift.base.errors import InputError
from colift.benchmark.episode.conditions import Conditions, read_conditions
from colift.benchmark.tasks.robust.telling import Telling
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True, eq=False)
class ToldNetwork:
    """A network, and what it is told."""

    network: GatedNetwork
    """Of :data:`.INPUTS` inputs, and those that are told."""
    telling: Telling
    conditions: Conditions
    """The conditions with which it was trained."""

    @property
    def untold(self) -> bool:
        """Whether it is told nothing, so that it is the network of a policy."""
        return not (self.telling.sensor or self.telling.person)

    def policy(self) -> GatedNetwork:
        """Return the network without the inputs that are told, which must be none."""
        network, own = self.network, self.network.units + INPUTS
        return network._replace(inputs=network.inputs[:, :INPUTS], output=network.output[:, :own])

    def dump(self) -> dict[str, NDArray[Any]]:
        """Return the arrays of its file; if it is told nothing, those of a policy's weights."""
        if self.untold:
            return self.policy()._asdict()
        about = {
            "behaviours": list(self.telling.behaviours),
            "sensor": self.telling.sensor,
            "person": self.telling.person,
            "conditions": self.conditions.plain(),
        }
        arrays = {name: np.asarray(array) for name, array in self.network._asdict().items()}
        return {**arrays, "about": np.array(json.dumps(about))}


def write_networks(networks: Mapping[str, ToldNetwork], folder: Path) -> None:
    """Write the file of each network into a new folder; see :func:`write_weights`."""
    write_weights({name: network.dump() for name, network in networks.items()}, folder)


def write_weights(networks: Mapping[str, Mapping[str, Any]], folder: Path) -> None:
    """Write the arrays of each network into a new folder, in a file of its name.

    Raises
    ------
    InputError
        If the folder or a file cannot be written.
    """
    try:
        folder.mkdir(parents=True)
        for name, arrays in networks.items():
            np.savez(folder / f"{name.replace(' ', '_')}.npz", **arrays)
    except OSError as error:
        raise InputError(f"cannot write {folder}: {error.strerror}") from error


def read_told(file: Path | Traversable) -> ToldNetwork:
    """Return the network of a file with the arrays of :meth:`.ToldNetwork.dump`.

    Raises
    ------
    InputError
        If the file cannot be read, or is no such file.
    """
    try:
        with np.load(io.BytesIO(file.read_bytes()), allow_pickle=False) as arrays:
            about = json.loads(str(arrays["about"]))
            telling = Telling(
                behaviours=tuple(map(str, about["behaviours"])),
                sensor=bool(about["sensor"]),
                person=bool(about["person"]),
            )
            conditions = read_conditions(about["conditions"], file.name)
            network = network_of(arrays, file.name, INPUTS + telling.size)
    except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"{file.name}: not a network that is told more: {error}") from None
    return ToldNetwork(network=network, telling=telling, conditions=conditions)
