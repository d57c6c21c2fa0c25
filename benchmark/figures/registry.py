"""The registry of the recorded figures: ``docs/figures/figures.toml``."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from colift.base.errors import InputError
from colift.base.text import parse_toml, read_bytes

REGISTRY: Final = "figures.toml"

LONGEST: Final = 1024 * 1024
"""Largest registry [bytes]."""

FOLDER: Final = Path("docs") / "figures"
"""Folder of the registry and of the recorded files, in a clone."""

ALL: Final = "*"
"""Stand-in for every registered policy."""


@dataclass(frozen=True, kw_only=True)
class RecordedFigure:
    """A command, the files that hold its output, and the origin of that output."""

    name: str
    command: str
    """Lines of a shell, as a reader types them. Files that the command writes have plain names."""
    text: bool = True
    """Whether the printed output is recorded, as ``NAME.txt``."""
    pictures: tuple[str, ...] = ()
    """Recorded pictures among the files that the command writes, by their paths: the last part of
    the path is the name in :data:`FOLDER`."""
    suites: tuple[str, ...] = ()
    """Suites whose digests cover the world, the people and the metrics."""
    policies: tuple[str, ...] = ()
    """Policies that are played, or :data:`ALL`."""
    code: tuple[str, ...] = ()
    """Other definitions on which the numbers depend, each as ``module:name`` without
    ``colift.``."""
    machine: bool = False
    """Whether the numbers are speeds of a machine: they are made again only on request."""
    recordings: tuple[str, ...] = ()
    """Names, in the command, of files of recorded lifts that colift does not contain."""

    @property
    def files(self) -> tuple[str, ...]:
        """Names of the recorded files."""
        printed = (f"{self.name}.txt",) if self.text else ()
        return (*printed, *(Path(picture).name for picture in self.pictures))


def clone_folder() -> Path:
    """Return the folder of the clone to which this code belongs.

    Raises
    ------
    InputError
        If colift is installed without its documentation.
    """
    folder = Path(__file__).resolve().parents[2]
    if not (folder / FOLDER / REGISTRY).is_file():
        raise InputError(
            f"the figures of the documentation are in a clone of colift only, not in {folder}"
        )
    return folder


def read_figures(folder: Path) -> dict[str, RecordedFigure]:
    """Return the registered figures by name, in the order of the registry.

    Parameters
    ----------
    folder
        Folder with the registry.

    Raises
    ------
    InputError
        If an entry is not as :class:`RecordedFigure` requires, or two record the same file.
    """
    path = folder / REGISTRY
    content = parse_toml(read_bytes(path, LONGEST), str(path))
    figures = {name: _figure(name, entry, path) for name, entry in content.items()}
    owners: dict[str, str] = {}
    for figure in figures.values():
        for file in figure.files:
            if file in owners:
                raise InputError(f"{path}: {owners[file]} and {figure.name} both record {file}")
            owners[file] = figure.name
    return figures


def _figure(name: str, entry: Any, path: Path) -> RecordedFigure:
    place = f"{path}: {name}"
    if not isinstance(entry, Mapping):
        raise InputError(f"{place}: must be a table, got {entry!r}")
    kinds = {
        field: kind for field, kind in RecordedFigure.__annotations__.items() if field != "name"
    }
    values: dict[str, Any] = {}
    for field, value in entry.items():
        if field not in kinds:
            raise InputError(f"{place}: unknown field {field!r}; fields: {', '.join(kinds)}")
        if kinds[field] == tuple[str, ...]:
            right = isinstance(value, list) and all(isinstance(each, str) for each in value)
            values[field] = tuple(value) if right else value
        else:
            right = isinstance(value, kinds[field])
            values[field] = value.strip() if isinstance(value, str) else value
        if not right:
            raise InputError(f"{place}: {field} cannot be {value!r}")
    if not values.get("command"):
        raise InputError(f"{place}: command is missing")
    figure = RecordedFigure(name=name, **values)
    if not figure.files:
        raise InputError(f"{place}: records neither text nor a picture")
    if not (figure.machine or figure.suites or figure.code):
        raise InputError(f"{place}: suites or code is missing, unless it measures the machine")
    return figure
