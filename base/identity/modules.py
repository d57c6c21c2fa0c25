"""Modules as tables of definitions: the statements that define each global name."""

import ast
import sys
from collections.abc import Iterator, Sequence
from importlib.util import find_spec, module_from_spec
from typing import Any, Final, NamedTuple

from colift.base.identity.statements import (
    Import,
    Statement,
    does_nothing,
    names_in,
    targets,
)

EFFECTS: Final = ""
"""The name for a module's statements that belong to none of its definitions."""


class Reference(NamedTuple):
    """A definition: a global name of a module; ``EFFECTS`` are the loose statements."""

    module: str
    name: str

    def value(self) -> object:
        """Return what the module has under the name; None if nothing, or if it is not imported."""
        return getattr(sys.modules.get(self.module), "__dict__", {}).get(self.name)


class Module:
    """The definitions and imports at the top level of a module.

    Parameters
    ----------
    name
        Its full name.
    source
        Its text or its syntax tree.
    package
        The package that its relative imports start from.
    """

    def __init__(self, name: str, source: str | bytes | ast.Module, package: str) -> None:
        self.name, self.package = name, package
        self.top = name.partition(".")[0]
        tree = source if isinstance(source, ast.Module) else ast.parse(source)
        run = list(_run(tree.body))
        self.imports = dict(
            pair for each in run if isinstance(each, Import) for pair in targets(each, package)
        )
        """What each name is that an import binds; that of ``*`` is the last such module."""
        statements = [Statement(each, package) for each in run if not isinstance(each, Import)]
        self.rebound = {name for each in statements for name in each.rebound}
        """Names that its functions bind."""
        self.definitions: dict[str, list[Statement]] = {}
        for each in statements:
            for bound in each.top.stored:
                self.definitions.setdefault(bound, []).append(each)
                self.imports.pop(bound, None)
        effects = [each for each in statements if not self._only_defines(each.node)]
        self.definitions |= {EFFECTS: effects} if effects else {}

    def _only_defines(self, node: ast.stmt) -> bool:
        """Return whether a statement gives names a value, and changes nothing else.

        A decorator of the same package may enter what it decorates anywhere.
        """
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                imports = self.imports.items()
                own = {name for name, (place, _) in imports if place.split(".")[0] == self.top}
                return not names_in(node.decorator_list) & (own | set(self.definitions))
            case ast.Assign(targets=targets):
                return all(isinstance(each, ast.Name | ast.Tuple) for each in targets)
            case ast.AnnAssign(target=target):
                return isinstance(target, ast.Name)
        return False


def read_module(name: str) -> Module | None:
    """Return a module from its source, without running it; None if no source is known.

    The packages that it is in are imported.
    """
    try:
        found: Any = sys.modules.get(name) or module_from_spec(find_spec(name))  # type: ignore
        source = found.__loader__.get_data(found.__file__)  # Of an archive, too.
    except (ImportError, AttributeError, TypeError, ValueError, OSError):
        return None
    return Module(name, source, found.__package__ or "") if found.__file__[-3:] == ".py" else None


def _run(body: Sequence[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements that an import runs."""
    for each in body:
        test = ast.unparse(each.test) if isinstance(each, ast.If) else ""
        if isinstance(each, ast.If) and test.removeprefix("typing.") == "TYPE_CHECKING":
            yield from _run(each.orelse)
        elif test != "__name__ == '__main__'" and not does_nothing(each):
            yield each
