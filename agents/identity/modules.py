"""Modules as tables of definitions: the statements that define each global name."""

import ast
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NamedTuple

Function = ast.FunctionDef | ast.AsyncFunctionDef
Comprehension = ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp
Import = ast.Import | ast.ImportFrom

NAMING: Final[dict[type[ast.AST], str]] = {
    ast.FunctionDef: "name",
    ast.AsyncFunctionDef: "name",
    ast.ClassDef: "name",
    ast.ExceptHandler: "name",
    ast.MatchAs: "name",
    ast.MatchStar: "name",
    ast.MatchMapping: "rest",
}
"""The field of a node that holds the name that it binds."""

EFFECTS: Final = ""
"""The name for a module's statements that belong to none of its definitions."""


class Reference(NamedTuple):
    """A definition: a global name of a module; ``EFFECTS`` are the loose statements."""

    module: str
    name: str


class Target(NamedTuple):
    """Target of an import: a module, or a name in it."""

    module: str
    name: str | None


@dataclass(frozen=True)
class Definition:
    """The statements that define a global name, in order."""

    statements: tuple[ast.stmt, ...]
    place: int
    """Position of the name among those that the first statement binds, as in ``a, b = 1, 2``."""


class Module:
    """The definitions and imports at the top level of a module.

    Parameters
    ----------
    name
        Its full name.
    tree
        Its syntax tree.
    package
        The package that its relative imports start from.
    folder
        Its folder; None for a text without a file.
    """

    def __init__(self, name: str, tree: ast.Module, package: str, folder: Path | None) -> None:
        self.name, self.tree, self.folder = name, tree, folder
        self._package = package
        self.imports: dict[str, Target] = {}
        self.stars: list[str] = []
        bound: dict[str, list[ast.stmt]] = {}
        others = []
        for statement in _top_level(tree.body):
            if isinstance(statement, Import):
                self._import(statement)
                continue
            for each in bound_names([statement]):
                bound.setdefault(each, []).append(statement)
            if not isinstance(statement, Function | ast.ClassDef) and not _only_binds(statement):
                others.append(statement)
        self.imports = {name: each for name, each in self.imports.items() if name not in bound}
        places = {name: bound_names(each[:1]).index(name) for name, each in bound.items()}
        loose = []
        for statement in others:
            names = dict.fromkeys(
                each.id for each in ast.walk(statement) if isinstance(each, ast.Name)
            )
            changed = [bound[name] for name in names if name in bound]
            for statements in changed:
                if statement not in statements:
                    statements.append(statement)
            if not changed:
                loose.append(statement)
        self.definitions = {
            name: Definition(tuple(each), places[name]) for name, each in bound.items()
        }
        if loose:
            self.definitions[EFFECTS] = Definition(tuple(loose), 0)

    def with_tree(self, tree: ast.Module) -> "Module":
        """Return the module with another source."""
        return Module(self.name, tree, self._package, self.folder)

    def targets(self, statement: Import) -> Iterator[tuple[str, Target]]:
        """Yield each name that an import statement binds, and to what."""
        if isinstance(statement, ast.Import):
            for alias in statement.names:
                top = alias.name.partition(".")[0]
                yield alias.asname or top, Target(alias.name if alias.asname else top, None)
            return
        source = statement.module or ""
        if level := statement.level:
            parts = self._package.split(".")
            base = ".".join(parts[: len(parts) - level + 1])
            source = f"{base}.{source}" if base and source else base or "." * level + source
        for alias in statement.names:
            yield alias.asname or alias.name, Target(source, alias.name)

    def _import(self, statement: Import) -> None:
        for name, target in self.targets(statement):
            if name == "*":
                self.stars.append(target.module)
            else:
                self.imports[name] = target


def read_module(name: str) -> Module | None:
    """Return a module from its source, without running it; None if no source is known.

    It, or its top package, must have been imported.
    """
    loaded = sys.modules.get(name)
    file = getattr(loaded, "__file__", None)
    if file:
        return _parsed(name, Path(file), getattr(loaded, "__package__", None) or "")
    top, *inner = name.split(".")
    for place in getattr(sys.modules.get(top), "__path__", ()):
        base = Path(place, *inner)
        for path, package in (
            (base / "__init__.py", name),
            (base.with_name(f"{base.name}.py"), name.rpartition(".")[0]),
        ):
            if path.is_file():
                return _parsed(name, path, package)
    return None


def _parsed(name: str, path: Path, package: str) -> Module | None:
    if path.suffix != ".py" or not path.is_file():
        return None
    return Module(name, ast.parse(path.read_bytes()), package, path.parent)


def _top_level(body: Sequence[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements that an import runs, and those for type checkers."""
    for statement in body:
        if isinstance(statement, ast.If):
            test = ast.unparse(statement.test)
            if test in ("TYPE_CHECKING", "typing.TYPE_CHECKING"):
                yield from _top_level(statement.body)
                continue
            if test in ("__name__ == '__main__'", "'__main__' == __name__"):
                continue
        if not does_nothing(statement):
            yield statement


def _only_binds(statement: ast.stmt) -> bool:
    """Return whether a statement gives names a value, and changes nothing else."""
    match statement:
        case ast.Assign(targets=targets):
            return all(isinstance(each, ast.Name | ast.Tuple) for each in targets) and not any(
                isinstance(each, ast.Attribute | ast.Subscript)
                for target in targets
                for each in ast.walk(target)
            )
        case ast.AnnAssign(target=ast.Name()):
            return True
    return False


def does_nothing(statement: ast.stmt) -> bool:
    """Return whether a statement is a docstring, another loose constant, or ``pass``."""
    match statement:
        case ast.Pass() | ast.Expr(value=ast.Constant()):
            return True
        case ast.AnnAssign(value=None):
            return True
    return False


def bound_names(body: Sequence[ast.AST]) -> list[str]:
    """Return the names that statements bind in their scope, in the order of first appearance."""
    if len(body) == 1 and isinstance(body[0], Function | ast.ClassDef):
        return [body[0].name]
    return list(dict.fromkeys(name for node in scope_nodes(body) for name in binds(node)))


def binds(node: ast.AST) -> tuple[str, ...]:
    """Return the names that a node by itself binds."""
    if isinstance(node, ast.Name):
        return () if isinstance(node.ctx, ast.Load) else (node.id,)
    if isinstance(node, Import):
        return tuple(each.asname or each.name.partition(".")[0] for each in node.names)
    field = NAMING.get(type(node))
    name = None if field is None else getattr(node, field)
    return () if name is None else (name,)


def scope_nodes(body: Sequence[ast.AST]) -> list[ast.AST]:
    """Return the nodes of a scope in order, without the insides of the scopes in it."""
    found = []
    left = list(reversed(body))
    while left:
        node = left.pop()
        found.append(node)
        if isinstance(node, Comprehension):
            # An assignment expression in a comprehension binds its name outside.
            found += [each.target for each in ast.walk(node) if isinstance(each, ast.NamedExpr)]
        elif not isinstance(node, Function | ast.ClassDef | ast.Lambda):
            inner: list[ast.AST] = []
            for name in node._fields:
                value = getattr(node, name, None)
                if isinstance(value, list):
                    inner += [each for each in value if isinstance(each, ast.AST)]
                elif isinstance(value, ast.AST) and name != "ctx":
                    inner.append(value)
            left += reversed(inner)
    return found
