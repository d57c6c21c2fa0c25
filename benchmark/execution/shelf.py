"""The episodes of a run: all scores in memory, the traces of a long run in a file."""

import contextlib
import functools
import os
import sys
import tempfile
import threading
import weakref
from array import array
from collections.abc import Iterator, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, Final, Protocol

from colift.agents.submissions.folder import unwritable
from colift.base.errors import InputError
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import Scores
from colift.benchmark.execution.records import append_record, episode_of, record_of, records

IN_MEMORY: Final = 300
"""Number of episodes that stay in memory whole, if a run has no journal: 14 MB."""

IN_FILE: Final = ("trace", "step_times", "log")
"""Fields of an episode on file, which are read whenever they are asked for."""


class Shelf(Protocol):
    """A place for the finished episodes of a run."""

    def keep(self, index: int, episode: Episode) -> Episode:
        """Keep an episode by its place in the suite; return it as memory holds it."""
        ...


class PackedScores(Mapping[str, float]):
    """Scores in a fifth of the memory of a dictionary: their names are those of other lifts."""

    __slots__ = ("_places", "_values")

    def __init__(self, scores: Scores) -> None:
        self._places = _places(tuple(scores))
        self._values = array("d", scores.values()).tobytes()

    def __getitem__(self, name: str) -> float:
        return float(memoryview(self._values).cast("d")[self._places[name]])

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)

    def __repr__(self) -> str:
        return repr(dict(self))


@functools.lru_cache
def _places(names: tuple[str, ...]) -> dict[str, int]:
    return {name: index for index, name in enumerate(names)}


class Shelved(Episode):
    """An episode whose :data:`IN_FILE` are not in memory; a copy or a pickle of it is whole."""

    _file: "EpisodeFile"
    _offset: int

    def __getattr__(self, name: str) -> Any:
        if name not in IN_FILE:
            raise AttributeError(f"an episode has no {name!r}", name=name, obj=self)
        return getattr(self._file.read(self._offset), name)

    def __reduce__(self) -> tuple[Any, ...]:
        values = {each.name: getattr(self, each.name) for each in fields(Episode)}
        return _whole, ({**values, "scores": dict(self.scores)},)


def _whole(values: dict[str, Any]) -> Episode:
    return Episode(**values)


class EpisodeFile:
    """Episodes in a file that only grows.

    Parameters
    ----------
    path
        The file. It can be read as long as anything refers to this, even if it is deleted.
    handle
        Its open descriptor, to append to it.

    Raises
    ------
    InputError
        If the file cannot be read.
    """

    def __init__(self, path: Path, handle: int) -> None:
        self.path = path
        self.handle = handle
        try:
            self.file = path.open("rb")
        except OSError as error:
            raise InputError(f"cannot read {path}: {error.strerror}") from error
        weakref.finalize(self, self.file.close)
        self._reading = threading.Lock()

    def keep(self, index: int, episode: Episode) -> Episode:
        """Append an episode; once this returns, it outlives this process.

        Raises
        ------
        InputError
            If it cannot be written.
        """
        try:
            offset = os.lseek(self.handle, 0, os.SEEK_END)
            append_record(self.handle, [index, record_of(episode)])
        except OSError as error:
            raise unwritable(self.path, error) from error
        return self.shelved(episode, offset)

    def shelved(self, episode: Episode, offset: int) -> Episode:
        """Return the episode of the record at an offset as memory holds it."""
        kept = {
            each.name: getattr(episode, each.name)
            for each in fields(Episode)
            if each.name not in IN_FILE
        }
        # Each worker's answer brings texts of its own.
        kept |= {name: sys.intern(kept[name]) for name in ("behaviour", "subject", "trial")}
        light = object.__new__(Shelved)
        values = {**kept, "scores": PackedScores(episode.scores), "_file": self, "_offset": offset}
        for name, value in values.items():
            object.__setattr__(light, name, value)
        return light

    def read(self, offset: int) -> Episode:
        """Return the whole episode of the record at an offset.

        Raises
        ------
        InputError
            If the file has been changed.
        """
        with self._reading:
            found = next(records(self.file, offset), None)
        if found is not None:
            (_, content), _ = found
            return episode_of(content)
        raise InputError(f"{self.path} has been changed while it was in use")


class Spool:
    """A shelf without a journal: long runs go to a file without a name, in ``TMPDIR``."""

    def __init__(self) -> None:
        self._kept = 0
        self._file: EpisodeFile | None = None

    def keep(self, index: int, episode: Episode) -> Episode:
        """Keep an episode, the first :data:`IN_MEMORY` whole in memory.

        Raises
        ------
        InputError
            If the file cannot be written.
        """
        self._kept += 1
        if self._kept <= IN_MEMORY:
            return episode
        if self._file is None:
            self._file = _unnamed_file()
        return self._file.keep(index, episode)


def _unnamed_file() -> EpisodeFile:
    try:
        handle, name = tempfile.mkstemp(prefix="colift-", suffix=".lifts")
    except OSError as error:
        raise unwritable(Path(tempfile.gettempdir()), error) from error
    with contextlib.ExitStack() as failed:
        failed.callback(os.close, handle)
        made = EpisodeFile(Path(name), handle)
        failed.pop_all()
    Path(name).unlink()
    weakref.finalize(made, os.close, handle)
    return made
