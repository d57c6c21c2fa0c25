"""Completion of names, and of folders and files that may be policies, for a shell."""

from collections.abc import Iterator
from pathlib import Path

from colift.base.registry import HUMANS, POLICIES, ROBOTS, entries, suite_names
from colift.benchmark.channels import CHANNELS
from colift.benchmark.rendering.layout import LAYOUTS


def policies(incomplete: str) -> Iterator[str]:
    """Yield the policies that begin with a text: registered ones, submissions and files."""
    yield from (name for name in entries(POLICIES) if name.startswith(incomplete))
    above, slash, start = incomplete.rpartition("/")
    try:
        found = sorted(Path(above + slash).iterdir())
    except OSError:
        return
    for path in found:
        place = f"{above}{slash}{path.name}"
        if path.name.startswith(start) and not (path.name.startswith(".") and not start):
            if path.is_dir() and _is_submission(path):
                yield place
            elif path.is_dir():
                yield f"{place}/"
            elif path.suffix == ".py":
                yield f"{place}:"


def suites(incomplete: str) -> Iterator[str]:
    """Yield the suites that begin with a text."""
    yield from (name for name in suite_names() if name.startswith(incomplete))


def robots(incomplete: str) -> Iterator[str]:
    """Yield the robots that begin with a text."""
    yield from (name for name in entries(ROBOTS) if name.startswith(incomplete))


def behaviours(incomplete: str) -> Iterator[str]:
    """Yield the human behaviours that begin with a text."""
    yield from (name for name in entries(HUMANS) if name.startswith(incomplete))


def channels(incomplete: str) -> Iterator[str]:
    """Yield the named channels that begin with a text."""
    yield from (name for name in CHANNELS if name.startswith(incomplete))


def layouts(incomplete: str) -> Iterator[str]:
    """Yield the sizes of figures that begin with a text."""
    yield from (name for name in LAYOUTS if name.startswith(incomplete))


def people(incomplete: str) -> Iterator[str]:
    """Yield the subjects that begin with a text."""
    from colift.agents.humans import (
        SUBJECTS,  # The people need NumPy, which other completions do not.
    )

    yield from (name for name in SUBJECTS if name.startswith(incomplete))


def _is_submission(folder: Path) -> bool:
    from colift.agents.submissions.manifest import MANIFEST

    return (folder / MANIFEST).is_file()
