"""Near misses: what a folder or an archive without a manifest has instead, and what to do."""

import difflib
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Final

from colift.agents.submissions.folder import LIMITS, is_part
from colift.agents.submissions.manifest import MANIFEST
from colift.base.errors import InputError, Remedy

ALIKE: Final = 0.8
"""Least similarity of a file's name to the manifest's that counts as a near miss, 0 to 1."""

PACK: Final = "pack"
NAME: Final = "give"

SHOWN: Final = 3
"""Number of places that are named."""


def no_manifest(paths: Iterable[str], what: str, action: str) -> InputError:
    """Return the error for files without a manifest; arguments as :func:`near_manifest`."""
    known = tuple(paths)
    near = near_manifest(known, what, action)
    if near is not None:
        return InputError(near, remedy=None if known else Remedy.NEW_SUBMISSION)
    return InputError(
        f"{what} has no {MANIFEST}; a submission is a folder with {MANIFEST} and policy.py",
        remedy=Remedy.NEW_SUBMISSION,
    )


def near_manifest(paths: Iterable[str], what: str, action: str = PACK) -> str | None:
    """Return in words what is there instead of ``policy.toml``, and what would be right.

    It is None if nothing comes near.

    Parameters
    ----------
    paths
        The paths of all files, with ``/`` between the names.
    what
        What holds them, such as ``the zip archive``.
    action
        What the user does with a folder: :data:`PACK` or :data:`NAME`.
    """
    known = sorted(paths, key=lambda path: (path.count("/"), path))
    if not known:
        return f"{what} is empty: it holds no file of a submission"
    deeper = [path for path in known if path.endswith(f"/{MANIFEST}")]
    if len(deeper) == 1:
        folder = deeper[0].rpartition("/")[0]
        cure = f"{action} the folder that contains it, {folder}"
        return f"{what} has no {MANIFEST}; found {deeper[0]}: {cure}"
    if deeper:
        some = ", ".join(deeper[:SHOWN])
        return (
            f"{what} has no {MANIFEST}; found {some}: {action} one of the folders that contain one"
        )
    named = [path for path in known if _alike(path.rpartition("/")[2])]
    if named:
        return f"{what} has no {MANIFEST}; found {named[0]}: {_cure(named[0].rpartition('/')[2])}"
    return None


def files_of(folder: Path, most: int = LIMITS.entries) -> tuple[str, ...]:
    """Return the paths of the first files in a folder, as :func:`near_manifest` takes them."""
    found = _walked(folder)
    return tuple(path for path, _ in zip(found, range(most), strict=False))


def _walked(folder: Path) -> Iterator[str]:
    for place, folders, names in os.walk(folder):
        inside = Path(place).relative_to(folder)
        deep = len(inside.parts) >= LIMITS.depth
        folders[:] = [] if deep else sorted(filter(is_part, folders))
        yield from ((inside / name).as_posix() for name in sorted(names) if is_part(name))


def _alike(name: str) -> bool:
    small = name.lower()
    close = difflib.SequenceMatcher(None, small, MANIFEST).ratio() >= ALIKE
    return small.startswith(f"{MANIFEST}.") or close


def _cure(name: str) -> str:
    """Return how a file of a near name becomes the manifest."""
    if name.lower().startswith(f"{MANIFEST}."):
        return f"rename it to {MANIFEST} (some systems hide the ending of a name)"
    if name.lower() == MANIFEST:
        return f"rename it to {MANIFEST}, in small letters"
    return f"rename it to {MANIFEST}, if it is the manifest"
