"""A new folder, written beside its place and then renamed: all of it, or nothing."""

import json
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from colift.base.errors import InputError
from colift.base.places import check_beside
from colift.benchmark.export.croissant import CROISSANT
from colift.benchmark.export.provenance import STAMP


def check_new(folder: Path, *, replace: bool) -> None:
    """Refuse a place for a new data set, before any work is done.

    Parameters
    ----------
    folder
        The place.
    replace
        Whether an older export may be there, which will be replaced.

    Raises
    ------
    InputError
        If anything else is there, such as a file that the export has not, or nothing can be written
        there.
    """
    if folder.is_symlink() or folder.exists():
        if not folder.is_dir():
            raise InputError(f"{folder} is a file, must be a new folder")
        if not replace:
            raise InputError(f"{folder} is there already; name a new folder, or add --force")
        if not (folder / STAMP).is_file():
            raise InputError(f"{folder} is not an export (it has no {STAMP}) and is not replaced")
        others = _others(folder)
        if others:
            raise InputError(f"{folder} holds other files ({others[0]}); name a new folder")
    check_beside(folder)


def _others(folder: Path) -> list[str]:
    """Return the files in the folder of an export that are not in its list of files."""
    try:
        listed = json.loads((folder / CROISSANT).read_text(encoding="utf-8"))["distribution"]
        own = {STAMP, CROISSANT, *(each["contentUrl"] for each in listed)}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{folder} has no readable {CROISSANT} and is not replaced") from error
    files = (path for path in folder.rglob("*") if not path.is_dir())
    return sorted({path.relative_to(folder).as_posix() for path in files} - own)


@contextmanager
def new_folder(folder: Path, *, replace: bool) -> Iterator[Path]:
    """Yield an empty folder beside its later place, and rename it if the body does not fail.

    Raises
    ------
    InputError
        As :func:`check_new`.
    """
    check_new(folder, replace=replace)
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=f".{folder.name}-") as temporary:
        made = Path(temporary) / "new"
        made.mkdir()
        yield made
        check_new(folder, replace=replace)
        if folder.exists():
            folder.rename(Path(temporary) / "older")
        made.rename(folder)
