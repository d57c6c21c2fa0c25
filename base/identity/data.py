"""The data files beside a module."""

import ast
import hashlib
import sys
from collections.abc import Iterator, Sequence
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Final

from colift.base.identity.modules import Module
from colift.base.identity.statements import Statement

CODE: Final = (".py", ".pyc", ".pyo", ".pyi", ".typed", ".so", ".pyd")


def data_hash(module: Module, statements: Sequence[Statement], *, everything: bool) -> str:
    """Return the hash of the data files that code may read.

    Parameters
    ----------
    module, statements
        The code. If strings in it are names of files in the module's package, it reads these;
        otherwise any of them. A module without a package reads those that it names.
    everything
        Whether all files of the module's top package count.
    """
    if not module.package:
        statements = [each for group in module.definitions.values() for each in group]
    inside = [part for each in statements for part in ast.walk(each.node)]
    named = {str(each.value) for each in inside if isinstance(each, ast.Constant)}
    if module.package:
        found = dict(_below(files(module.top if everything else module.package)))
        chosen = [name for name in found if name.rpartition("/")[2] in named and not everything]
        kept = [found[name] for name in sorted(chosen or found)]
    else:
        file = getattr(sys.modules.get(module.name), "__file__", None)
        beside = [Path(file).parent / each for each in sorted(named) if each] if file else []
        kept = [each for each in beside if each.is_file()]
    return " ".join([hashlib.sha256(each.read_bytes()).hexdigest() for each in kept])


def _below(folder: Traversable, path: str = "") -> Iterator[tuple[str, Traversable]]:
    for each in folder.iterdir():
        if each.is_dir() and not each.name.startswith((".", "__")):
            yield from _below(each, f"{path}{each.name}/")
        elif each.is_file() and not each.name.startswith(".") and not each.name.endswith(CODE):
            yield f"{path}{each.name}", each
