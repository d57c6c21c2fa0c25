"""Scopes inside a definition: local names as numbers, imports as targets."""

import ast
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Literal

from colift.agents.identity.modules import Import, Module, Target, binds, bound_names, scope_nodes

Kind = Literal["function", "class", "comprehension"]


@dataclass(frozen=True)
class Scope:
    """The names of a function, a class or a comprehension."""

    kind: Kind
    names: dict[str, int]
    """Number of each name, in the order of the first places that bind it."""
    imports: dict[str, Target] = field(default_factory=dict)
    """Names that are bound by one import only."""
    globals: frozenset[str] = frozenset()
    """Names that a ``global`` statement declares."""


def body_scope(
    kind: Kind, parameters: Sequence[str], body: Sequence[ast.AST], module: Module
) -> Scope:
    """Return the scope of a function's or class's body."""
    inside = scope_nodes(body)
    outer = {n for each in inside if isinstance(each, ast.Nonlocal) for n in each.names}
    of_module = {n for each in inside if isinstance(each, ast.Global) for n in each.names}
    bound = [*parameters, *(name for each in inside for name in binds(each))]
    imports = {
        name: target
        for each in inside
        if isinstance(each, Import)
        for name, target in module.targets(each)
        if bound.count(name) == 1
    }
    left = [name for name in bound if name not in {*outer, *of_module, *imports}]
    return Scope(kind, _numbered(left), imports, frozenset(of_module))


def comprehension_scope(generators: Sequence[ast.comprehension]) -> Scope:
    """Return the scope of a comprehension's targets."""
    return Scope("comprehension", _numbered(bound_names([each.target for each in generators])))


def local_meaning(scopes: Sequence[Scope], name: str) -> str | Target | None:
    """Return the meaning of a name in nested scopes, the innermost last.

    Returns
    -------
    object
        The text of a local variable, the target of a local import, or None for a global name.
    """
    innermost = len(scopes) - 1
    for depth in range(innermost, -1, -1):
        scope = scopes[depth]
        if scope.kind == "class" and depth != innermost:
            continue
        if name in scope.globals:
            return None
        if name in scope.imports:
            return scope.imports[name]
        if name in scope.names:
            # The names of a class are attributes: they keep their spelling.
            local = name if scope.kind == "class" else scope.names[name]
            return f"(local {depth} {local})"
    return None


def _numbered(names: Iterable[str]) -> dict[str, int]:
    return {name: i for i, name in enumerate(dict.fromkeys(names))}
