"""Sources of modules, found without an import, which would run their code."""

import importlib.util
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path

from colift.agents.sandbox.host.view import view
from colift.base.errors import InputError
from colift.base.identity import source_hash


def module_digest(name: str) -> str:
    """Return the hash of a module's source file; see :func:`.source_hash`.

    Parameters
    ----------
    name
        Its full name.

    Raises
    ------
    InputError
        If there is no such module, it has no source, or a sandbox does not see it.
    """
    source = _source(name)
    if not any(source.is_relative_to(each) for each in view(None).visible()):
        if name.startswith("colift."):
            raise InputError(f"module {name!r} is colift's own, which a sandbox does not see")
        raise InputError(
            f"module {name!r} is {source}, which a sandbox does not see: install its package, not "
            f"as editable, name the file, as in {source.name}:Class, or make it a submission"
        )
    return source_hash(source.read_bytes())


def _source(name: str) -> Path:
    if name.startswith("colift."):
        spec = _found(name)
    else:
        # importlib would run a package to find the modules in it.
        path, *inner = name.split(".")
        spec = _found(path)
        for part in inner:
            inside = None if spec is None else spec.submodule_search_locations
            path = f"{path}.{part}"
            spec = None if inside is None else PathFinder.find_spec(path, list(inside))
    if spec is None:
        raise InputError(f"cannot import module {name!r}: there is no such module")
    if not (spec.origin and Path(spec.origin).is_file()):
        raise InputError(f"module {name!r} has no source file; name one that has the class")
    return Path(spec.origin).resolve()


def _found(name: str) -> ModuleSpec | None:
    try:
        return importlib.util.find_spec(name)
    except (ImportError, ValueError):  # An imported module may have no specification.
        return None
