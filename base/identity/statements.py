"""Statements as texts of their behaviour: no comments, positions, annotations or wording."""

import ast
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import CodeType
from typing import Any, Final, NamedTuple

Import = ast.Import | ast.ImportFrom
IMPORTS: Final = {ast.Import, ast.ImportFrom}
Function = ast.FunctionDef | ast.AsyncFunctionDef

IGNORED: Final = {"ctx", "kind", "annotation", "returns", "type_params", "type_comment", "msg"}
"""Fields of syntax trees that have no effect, or repeat another field; messages of assertions."""

INNER: Final[dict[type[ast.AST], str]] = {
    ast.ClassDef: "class",
    **dict.fromkeys((ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda), "function"),
    **dict.fromkeys((ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp), "function"),
}
"""Nodes with variables of their own."""

NAMING: Final = {
    *((kind, "name") for kind in (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)),
    *((kind, "name") for kind in (ast.ExceptHandler, ast.MatchAs, ast.MatchStar)),
    *((ast.MatchMapping, "rest"), (ast.arg, "arg")),
}
"""Fields with the name of a variable that the node binds."""

SPECIAL: Final = {
    *(ast.Name, ast.Attribute, ast.Import, ast.ImportFrom, ast.AnnAssign, ast.Raise),
    *(ast.FunctionDef, ast.arg, ast.Global),
}
"""Nodes that are not read field by field, or not only."""

FIELD_KINDS: Final = {"ClassVar", "InitVar", "KW_ONLY"}
"""Annotations that decide what a dataclass does with a field."""


class Target(NamedTuple):
    """Target of an import: a module, or a name in it."""

    module: str
    name: str | None


@dataclass(frozen=True)
class Region:
    """A part of a statement in which a name means one thing: a function with all that is in it.

    Others are the body of a class outside functions, and the module's.
    """

    kind: str = "module"
    in_function: bool = False
    numbers: dict[str, int] = field(default_factory=dict)
    """The number of each name, in the order of their first places."""
    stored: set[str] = field(default_factory=set)
    imports: dict[str, list[Target]] = field(default_factory=dict)

    def inside(self, kind: str) -> "Region":
        """Return the region of a definition in this one."""
        if self.in_function:
            return replace(self, kind=kind)
        return Region(kind, in_function=kind == "function")


class Use(NamedTuple):
    """A place in a statement where a name stands, with the attributes taken of it."""

    region: Region
    name: str
    attributes: str
    stored: bool


class Statement:
    """A statement of a module as texts, with uses of names and targets of imports among them.

    Parameters
    ----------
    node
        The statement.
    package
        The package that relative imports start from.
    """

    def __init__(self, node: ast.stmt, package: str) -> None:
        self.node, self.package = node, package
        self.top = Region()
        """The names that it binds in the module."""
        self.pieces: list[str | Use | Target] = []
        self.rebound: set[str] = set()
        """Names of the module that its functions bind."""
        left: list[tuple[ast.AST, Region]] = [(node, self.top)]
        while left:
            each, region = left.pop()
            if type(each) in SPECIAL:
                left += self._special(each, region)
            else:
                left += self._plain(each, region)

    @cached_property
    def outer(self) -> frozenset[str]:
        """Names that may mean variables of the module, even if it has some of its own."""
        codes = [compile(ast.Module([self.node], []), "", "exec", dont_inherit=True)]
        for code in codes:  # It grows meanwhile.
            codes += [each for each in code.co_consts if isinstance(each, CodeType)]
        return frozenset(name for code in codes for name in code.co_names)

    def _special(self, node: ast.AST, region: Region) -> list[tuple[ast.AST, Region]]:
        match node:
            case ast.Name():
                return self._use(region, node.id, "", stored=not isinstance(node.ctx, ast.Load))
            case ast.Attribute(value=base, attr=attributes):
                while isinstance(base, ast.Attribute):
                    attributes = f"{base.attr}.{attributes}"
                    base = base.value
                if isinstance(base, ast.Name):
                    return self._use(region, base.id, attributes, stored=False)
                self.pieces.append(f"Attribute {attributes}")
                return [(base, region)]
            case ast.Import() | ast.ImportFrom():
                for name, target in targets(node, self.package):
                    if region.kind == "function":
                        region.imports.setdefault(name, []).append(target)
                    else:
                        self._use(region, name, "", stored=True)
                        self.pieces.append(target)
                return []
            case ast.Raise(exc=ast.Call(func=raised)):
                node = ast.Raise(raised)  # Its wording is not behaviour.
            case ast.AnnAssign(target=target, value=value):
                if region.kind == "class":
                    words = set(re.findall(r"\w+", ast.unparse(node.annotation)))
                    self.pieces.append(f"field {sorted(words & FIELD_KINDS)} {value is None}")
                node = ast.Assign([target], value or ast.Constant(...))
            case ast.FunctionDef(decorator_list=[ast.Attribute(attr="register"), *_]):
                # ``functools.singledispatch`` tells functions apart by their annotations.
                self.pieces.append(ast.unparse(node.args))
            case ast.arg():
                self.pieces.append(node.arg)  # A call may name it.
            case ast.Global():
                self.rebound.update(node.names)
        return self._plain(node, region)

    def _plain(self, node: ast.AST, region: Region) -> list[tuple[ast.AST, Region]]:
        """Add a node's text, field by field, and return the nodes in it, the last one first."""
        kind = type(node)
        inner = region.inside(INNER[kind]) if kind in INNER else region
        text, found = [kind.__name__], []
        for name in node._fields:
            if name in IGNORED:
                continue
            value = getattr(node, name, None)
            values: list[Any] = value if isinstance(value, list) else [value]
            text.append(f"{name}:")
            for each in _working(values, inner) if name.endswith("body") else values:
                if isinstance(each, ast.AST):
                    found.append((each, inner))
                    # The uses of what a function imports name its place.
                    text += [] if inner.kind == "function" and type(each) in IMPORTS else ["."]
                elif each is not None and (kind, name) in NAMING:
                    found.append((ast.Name(each, ast.Store()), region))
                else:
                    text.append(repr(each))
        self.pieces.append(" ".join(text))
        return found[::-1]

    def _use(self, region: Region, name: str, attributes: str, *, stored: bool) -> list[Any]:
        region.numbers.setdefault(name, len(region.numbers))
        if stored:
            region.stored.add(name)
            if region.kind == "class":
                self.pieces.append(name)  # It is an attribute.
        self.pieces.append(Use(region, name, attributes, stored))
        return []


def targets(node: Import, package: str) -> Iterator[tuple[str, Target]]:
    """Yield each name that an import statement in a package binds, and to what."""
    source = ""
    if isinstance(node, ast.ImportFrom):
        above = package.split(".")[: 1 - node.level or None] if node.level else []
        source = ".".join([*above, *filter(None, [node.module])])
    for each in node.names:
        name = each.asname or each.name
        if source:
            yield name, Target(source, each.name)
        else:
            top = name.partition(".")[0]
            yield top, Target(each.name if each.asname else top, None)


def does_nothing(node: ast.AST, kind: str = "module") -> bool:
    """Return whether a statement is a docstring, another loose constant, or ``pass``.

    In a class, but not elsewhere, an annotation alone is a field.
    """
    if isinstance(node, ast.AnnAssign):
        return node.value is None and kind != "class"
    constant = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return constant or isinstance(node, ast.Pass)


def _working(nodes: list[ast.stmt], region: Region) -> list[ast.stmt]:
    """Return the statements that do something; in a class, methods come last and by name.

    Where the order of methods matters, they keep it.
    """
    nodes = [each for each in nodes if not does_nothing(each, region.kind)]
    methods = {each.name: each for each in nodes if isinstance(each, Function)}
    others = [each for each in nodes if not isinstance(each, Function)]
    if region.kind != "class" or len(methods) + len(others) < len(nodes):
        return nodes
    ordered = others + [methods[name] for name in sorted(methods)]
    return nodes if names_in(others) & set(methods) else ordered


def names_in(nodes: Sequence[ast.AST]) -> set[str]:
    """Return the names of variables anywhere in some nodes."""
    return {each.id for node in nodes for each in ast.walk(node) if isinstance(each, ast.Name)}
