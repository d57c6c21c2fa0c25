"""The packages that a submission may import, and those that it imports."""

import ast
import importlib.util
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Final

from colift.agents.submissions.folder import FolderContents

PACKAGES: Final[Mapping[str, str]] = {
    "filterpy": "filterpy",
    "numpy": "numpy",
    "scikit-learn": "sklearn",
    "scipy": "scipy",
}
"""Packages of every sandbox: the name in package registries, and the name of the module.

All come with colift, except scikit-learn, which comes with the extra ``learn``."""

ALWAYS: Final = frozenset(sys.stdlib_module_names) | {"colift"}
"""Modules that every policy may import: the standard library and colift, of which
sandboxes have ``colift.base`` and ``colift.agents``."""

SOURCE_BYTES: Final = 2**20
"""Largest source file that is parsed [bytes]: the parser takes 500 times as much memory."""


def installed(package: str) -> bool:
    """Return whether one of :data:`PACKAGES` is installed here, without importing it."""
    return importlib.util.find_spec(PACKAGES[package]) is not None


def undeclared(folder: Path, contents: FolderContents, packages: tuple[str, ...]) -> Iterator[str]:
    """Yield a message for each import that is neither declared nor in :data:`ALWAYS`.

    The sources are parsed, never run: only ``import`` statements are seen.

    Parameters
    ----------
    folder, contents
        The submission's folder and its files.
    packages
        The declared packages.
    """
    own = {path.partition("/")[0].removesuffix(".py") for path in contents.paths}
    allowed = ALWAYS | own | {PACKAGES[package] for package in packages}
    names = {module: package for package, module in PACKAGES.items()}
    for path in contents.paths:
        if not path.endswith(".py"):
            continue
        with (folder / path).open("rb") as file:
            source = file.read(SOURCE_BYTES + 1)
        if len(source) > SOURCE_BYTES:
            yield f"{path} is larger than 1 MiB; move its data to a data file"
            continue
        for module in sorted(_imported(source) - allowed):
            if module in names:
                yield f"{path} imports {module}: add {names[module]!r} to packages"
            else:
                yield (
                    f"{path} imports {module}, which boards need not have; "
                    f"a submission may declare {', '.join(PACKAGES)}"
                )


def needed(source: bytes) -> tuple[str, ...]:
    """Return which of :data:`PACKAGES` a source imports."""
    imported = _imported(source)
    return tuple(package for package, module in PACKAGES.items() if module in imported)


def _imported(source: bytes) -> set[str]:
    """Return the outermost modules that a source imports; none if it is not Python."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    found = set()
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                found |= {alias.name.partition(".")[0] for alias in names}
            case ast.ImportFrom(module=str(module), level=0):
                found.add(module.partition(".")[0])
    return found
