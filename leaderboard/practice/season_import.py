"""Practice seasons as files, and their import into new boards.

``practice-SUITE.json`` has secret, rows and errors; ``practice-SUITE.zip`` has a folder for each
policy, with the parts of its public run that pages show.
"""

import dataclasses
import io
import json
import logging
import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, Final, Self

from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.board import SUITE, Board
from colift.leaderboard.core.seasons import ImportedSeason
from colift.leaderboard.database.room import NoRoomError
from colift.leaderboard.practice.season import SUITES, practice_season
from colift.leaderboard.records.season import BoardEntry, PlayedEntry, SeasonInfo
from colift.leaderboard.storage.store import has_board

FORMAT: Final = 3

log: Final = logging.getLogger(__name__)

DATA: Final = Path(__file__).parents[1] / "data"
"""Folder of the practice seasons."""

_DATE: Final = (1980, 1, 1, 0, 0, 0)
"""Time stamp of all files in the archive, so that equal files make equal archives."""


@dataclass(frozen=True, kw_only=True)
class PlayedSeason:
    """A practice season with its evaluated policies."""

    suite: str
    suite_digest: str
    began_at: datetime
    human_human: ScoreTable
    """Two people on the hidden episodes."""
    references: Mapping[str, ScoreTable]
    """The references on the hidden episodes, by name."""
    played: tuple[PlayedEntry, ...]
    """In the order of their names."""

    @classmethod
    def read(cls, suite: str, folder: Path = DATA) -> Self | None:
        """Return the practice season of a suite; None if there is none of this format."""
        path, archive = _files(folder, suite)
        if not (path.is_file() and archive.is_file()):
            return None
        content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if content["format"] != FORMAT:
            return None
        with zipfile.ZipFile(archive) as packed:
            played = tuple(_played(each, packed) for each in content["played"])
        return cls(
            suite=content["suite"],
            suite_digest=content["suite_digest"],
            began_at=datetime.fromisoformat(content["began_at"]),
            human_human=ScoreTable.read(content["human_human"]),
            references={
                name: ScoreTable.read(each) for name, each in content["references"].items()
            },
            played=played,
        )

    def write(self, folder: Path) -> None:
        """Write the two files, the archive first, since the other refers to it."""
        path, archive = _files(folder, self.suite)
        content = {
            "format": FORMAT,
            "suite": self.suite,
            "suite_digest": self.suite_digest,
            "secret": practice_season(self.suite).secret.hex(),
            "began_at": self.began_at.isoformat(),
            "human_human": self.human_human.plain(),
            "references": {name: each.plain() for name, each in self.references.items()},
            "played": [
                {"entry": each.entry.plain(), "hidden_rmse_mm": list(each.hidden_rmse_mm)}
                for each in self.played
            ],
        }
        text = json.dumps(content, separators=(",", ":"), allow_nan=False).encode()
        for target, data in ((archive, self._archive()), (path, text + b"\n")):
            partial = target.with_name(f".{target.name}.partial")
            partial.write_bytes(data)
            partial.replace(target)

    def with_played(self, new: PlayedEntry) -> Self:
        """Return the season with a policy's evaluation, which replaces an older one."""
        others = [each for each in self.played if each.entry.name != new.entry.name]
        played = sorted([*others, new], key=lambda each: each.entry.name)
        return dataclasses.replace(self, played=tuple(played))

    def _archive(self) -> bytes:
        buffer = io.BytesIO()
        with zipfile.ZipFile(buffer, "w") as packed:
            for each in self.played:
                for name, data in sorted(each.files.items()):
                    file = zipfile.ZipInfo(f"{each.entry.name}/{name}", _DATE)
                    packed.writestr(file, data, zipfile.ZIP_DEFLATED, 9)
        return buffer.getvalue()


def practice_import(
    suite: str, folder: Path = DATA, *, current: bool = True
) -> ImportedSeason | None:
    """Return the practice season of a suite for import into a board.

    It is None if there is none for this suite and its digest.

    Parameters
    ----------
    suite
        The suite's name.
    folder
        Folder of the files.
    current
        Whether it takes submissions.
    """
    found = PlayedSeason.read(suite, folder)
    if found is None or found.suite_digest != make_suite(suite).digest:
        return None
    season = practice_season(suite)
    info = SeasonInfo(
        name=season.name,
        suite=season.suite.name,
        suite_digest=season.suite.digest,
        commitment=season.commitment,
        began_at=found.began_at,
        current=current,
        revealed=season.secret.hex(),
    )
    return ImportedSeason(
        info=info,
        entries=found.played,
        human_human=found.human_human,
        references=found.references,
    )


def _played(content: dict[str, Any], packed: zipfile.ZipFile) -> PlayedEntry:
    entry = BoardEntry.read(content["entry"])
    prefix = f"{entry.name}/"
    names = [name for name in packed.namelist() if name.startswith(prefix)]
    return PlayedEntry(
        entry=entry,
        hidden_rmse_mm=tuple(content["hidden_rmse_mm"]),
        files={name.removeprefix(prefix): packed.read(name) for name in names},
    )


def _files(folder: Path, suite: str) -> tuple[Path, Path]:
    return folder / f"practice-{suite}.json", folder / f"practice-{suite}.zip"


def open_with_practice(folder: Path, suite: str | None = None, data: Path = DATA) -> Board:
    """Open the board in a folder; a new one begins with the practice season of its suite.

    The practice seasons of other suites are imported as frozen seasons. A shipped one of another
    digest, as after a change of the code, is left out, with a warning to the log.

    Parameters
    ----------
    folder, suite
        As for :meth:`.Board.open`.
    data
        Folder of the practice seasons.

    Raises
    ------
    InputError
        As :meth:`.Board.open`.
    """
    if folder.is_dir() and any(folder.iterdir()):
        return Board.open(folder, suite)
    wanted = suite or SUITE
    practice = practice_import(wanted, data)
    board = Board.open(folder, suite, practice=practice)
    if practice is None and PlayedSeason.read(wanted, data) is not None:
        log.warning(
            "this board begins without rows: the shipped practice rows are of another digest of "
            "%s; 'colift practice --out %s' makes them again, for new boards",
            wanted,
            _from_here(data),
        )
    for other in SUITES:
        if practice is not None and other != wanted:
            frozen = practice_import(other, data, current=False)
            if frozen is not None:
                board.import_season(frozen)
    return board


def _from_here(folder: Path) -> Path:
    """Return a folder relative to the working directory, if it is in there."""
    place, here = folder.resolve(), Path.cwd()
    return place.relative_to(here) if place.is_relative_to(here) else place


def open_to_read(folder: Path) -> Board:
    """Open the board in a folder for reading, even if the folder is read-only or its disk is full.

    Raises
    ------
    InputError
        As :meth:`.Board.open`.
    """
    if has_board(folder) and not os.access(folder, os.W_OK):
        return Board.look(folder)
    try:
        return open_with_practice(folder)
    except NoRoomError:
        if not has_board(folder):
            raise
        return Board.look(folder)
