"""Files of policies, read without running them, and how they name a policy."""

import ast
from pathlib import Path
from typing import Final

from colift.base.errors import InputError

METHODS: Final = frozenset({"reset", "act"})
"""Methods of a policy."""

ONNX: Final = ".onnx"
"""Suffix of the file of a network."""

LARGEST: Final = 2**20
"""Largest source file that is parsed [bytes]: the parser takes 500 times as much memory."""


def classes(path: Path) -> dict[str, ast.ClassDef]:
    """Return the classes of a Python file by name, without running it.

    Raises
    ------
    InputError
        If there is no such file, or it is not Python.
    """
    return {node.name: node for node in _tree(path).body if isinstance(node, ast.ClassDef)}


def policies_in(path: Path) -> tuple[str, ...]:
    """Return the names of the classes of a file that may be its policy, the likeliest first.

    These are the classes with both methods; else those that may inherit one; else all. The last of
    a file comes first, since files define what they use before they use it. A file that cannot be
    read has none.
    """
    try:
        found = [*classes(path).values()][::-1]
    except InputError:
        return ()
    complete = [each.name for each in found if _methods(each) >= METHODS]
    derived = [each.name for each in found if each.bases and "act" in _methods(each)]
    return tuple(complete or derived or [each.name for each in found])


def with_class(path: Path) -> str:
    """Return a Python file with each class that may be its policy: ``file.py:Class``."""
    return " or ".join(f"{path}:{name}" for name in policies_in(path) or ("Class",))


def _tree(path: Path) -> ast.Module:
    try:
        if path.stat().st_size > LARGEST:
            raise InputError(f"{path} has more than {LARGEST} bytes")
        return ast.parse(path.read_bytes())
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise InputError(f"{path} is not Python: {error}") from error


def _methods(policy: ast.ClassDef) -> set[str]:
    """Return the names of the methods in the body of a class."""
    return {each.name for each in policy.body if isinstance(each, ast.FunctionDef)}
