"""Data files that a definition reads: a hash of their content in place of their names."""

import ast
import hashlib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Final

from colift.agents.identity.modules import Reference

FINDER: Final = "<importlib.resources.files>"
"""The function that finds data files: ``files(__package__).joinpath("data", "file.json")`` stands
for that file's content, and so does a package in place of ``__package__``. For any other argument,
and where our own code uses its ``__file__``, all data files of the folder count."""


class DataFiles:
    """The data files that a module's code can find.

    Parameters
    ----------
    module
        The module's name.
    folder_of
        Returns the folder of one of our own modules, None for others.
    meaning
        Returns the meaning of a plain or dotted name; None for any other expression.
    """

    def __init__(
        self,
        module: str,
        folder_of: Callable[[str], Path | None],
        meaning: Callable[[ast.expr], str | Reference | None],
    ) -> None:
        self._module, self._folder_of, self._meaning = module, folder_of, meaning

    def all(self) -> str | None:
        """Return the hash of every data file of the module's folder; None if it has no folder."""
        folder = self._folder_of(self._module)
        return None if folder is None else _hash(_below(folder))

    def found_by(self, call: ast.Call) -> str | None:
        """Return the hash of the data files that a call of the finder by itself may reach."""
        return self.all() if self._meaning(call.func) == FINDER else None

    def joined_by(self, call: ast.Call) -> str | None:
        """Return the hash of the files of ``files(package).joinpath(...)``; None if it is not one.

        Where the names are not literal, every file of the package counts.
        """
        match call:
            case ast.Call(
                func=ast.Attribute(value=ast.Call(func=finder, args=[package]), attr="joinpath"),
                args=parts,
            ) if parts and self._meaning(finder) == FINDER:
                folder = self._folder(package)
            case _:
                return None
        if folder is None:
            return None
        names = [str(each.value) for each in parts if isinstance(each, ast.Constant)]
        return _hash([folder.joinpath(*names)] if len(names) == len(parts) else _below(folder))

    def _folder(self, package: ast.expr) -> Path | None:
        """Return the folder of one of our own packages; None for others."""
        match package:
            case ast.Name(id="__package__"):
                return self._folder_of(self._module)
            case ast.Constant(value=str(name)):
                return self._folder_of(name)
            case ast.Name():
                found = self._meaning(package)
                return self._folder_of(found.module) if isinstance(found, Reference) else None
        return None


def _hash(paths: Iterable[Path]) -> str:
    sha = hashlib.sha256()
    for path in paths:
        sha.update(hashlib.sha256(path.read_bytes()).digest())
    return sha.hexdigest()


def _below(folder: Path) -> list[Path]:
    return sorted(
        path
        for path in folder.rglob("*")
        if path.is_file() and path.suffix not in (".py", ".pyc", ".typed")
    )
