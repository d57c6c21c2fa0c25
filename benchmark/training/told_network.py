"""Networks that are told more than a policy, and their files."""

import io
import json
import zipfile
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

    def dump(self) -> dict[str, NDArray[Any]]:
        """Return the arrays of its file."""
        about = {
            "behaviours": list(self.telling.behaviours),
            "sensor": self.telling.sensor,
            "person": self.telling.person,
            "conditions": self.conditions.plain(),
        }
        arrays = {name: np.asarray(array) for name, array in self.network._asdict().items()}
        return {**arrays, "about": np.array(json.dumps(about))}


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
