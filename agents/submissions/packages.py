"""The packages that a submission may need, and which it imports."""

import ast
import importlib.util
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Final

from .folder import Contents

PACKAGES: Final[Mapping[str, str]] = {
    "filterpy": "filterpy",
    "numpy": "numpy",
    "scikit-learn": "sklearn",
    "scipy": "scipy",
}
"""What every sandbox has, by the name in package registries, and the name it is imported by.

All come with colift, but for scikit-learn, which comes with its extra ``learn``."""

ALWAYS: Final = frozenset(sys.stdlib_module_names) | {"colift"}
"""What every policy may import: the standard library and ``colift.agents``."""


SOURCE_BYTES: Final = 2**20
"""Largest source file that is read for its imports [bytes]: Python needs 500 times as much."""


def installed(package: str) -> bool:
    """Whether one of :data:`PACKAGES` is installed here; it is not imported for that."""
    return importlib.util.find_spec(PACKAGES[package]) is not None


def undeclared(folder: Path, contents: Contents, packages: tuple[str, ...]) -> Iterator[str]:
    """Yield, in words, each import of what is neither declared nor always there.

    The source is read, never run: an import by another way than the statement is not seen.

    Parameters
    ----------
    folder, contents
        Where the files are, and which.
    packages
        The packages that are declared.
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
            yield f"{path} is larger than 1 MiB; put its data into a file that is no source"
            continue
        for module in sorted(_imported(source) - allowed):
            if module in names:
                yield f"{path} imports {module}: add {names[module]!r} to packages"
            else:
                yield (
                    f"{path} imports {module}, which a submission cannot ask for: whether it is "
                    f"there differs from board to board; what it can: {', '.join(PACKAGES)}"
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
