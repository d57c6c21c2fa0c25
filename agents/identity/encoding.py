"""Definitions as text of their behaviour alone, without names, positions and wording."""

import ast
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Final

from colift.agents.identity.data_files import DataFiles
from colift.agents.identity.modules import (
    NAMING,
    Comprehension,
    Definition,
    Function,
    Import,
    Module,
    Reference,
    Target,
    bound_names,
    does_nothing,
)
from colift.agents.identity.scopes import Scope, body_scope, comprehension_scope, local_meaning

Piece = str | Reference
Resolve = Callable[[Target], Piece]
"""Returns the definition that a target stands for, or a text if it is not our own."""

IGNORED: Final = frozenset({"ctx", "kind", "returns", "type_comment", "type_ignores"})
"""Fields of syntax trees that have no effect, or repeat another field."""


def encoded(
    definition: Definition,
    module: Module,
    resolve: Resolve,
    folder_of: Callable[[str], Path | None],
) -> tuple[Piece, ...]:
    """Return a definition as texts and references to other definitions.

    Comments, docstrings, positions, annotations (except in a class's body, where they may declare
    fields) and the arguments of raised exceptions are left out. Local variables are numbered.

    Parameters
    ----------
    definition, module
        The definition, and the module that it is in.
    resolve
        Returns the meaning of a global name.
    folder_of
        Returns the folder of one of our own modules, for its data files.
    """
    encoder = _Encoder(module, resolve, folder_of)
    encoder.text(f"[{definition.place}]")
    for statement in definition.statements:
        encoder.top_level(statement)
    return tuple(encoder.joined())


class _Encoder:
    def __init__(
        self, module: Module, resolve: Resolve, folder_of: Callable[[str], Path | None]
    ) -> None:
        self._module = module
        self._resolve = resolve
        self._data = DataFiles(module.name, folder_of, self._meaning)
        self._pieces: list[Piece] = []
        self._scopes: list[Scope] = []
        self._stored: list[str] = []

    def text(self, text: str) -> None:
        self._pieces.append(text)

    def joined(self) -> Iterable[Piece]:
        """Yield the pieces with neighbouring texts joined."""
        texts: list[str] = []
        for piece in self._pieces:
            if isinstance(piece, Reference):
                yield "".join(texts)
                yield piece
                texts = []
            else:
                texts.append(piece)
        yield "".join(texts)

    def top_level(self, statement: ast.stmt) -> None:
        self._stored = bound_names([statement])
        self.node(statement)

    def node(self, node: ast.AST) -> None:
        """Encode any node."""
        special = _SPECIAL.get(type(node))
        if special is None:
            self._generic(node)
        else:
            special(self, node)

    def _constant(self, node: ast.Constant) -> None:
        self.text(f"({type(node.value).__name__} {node.value!r})")

    def _named(self, node: ast.Name) -> None:
        self._name(node.id, node.ctx)

    def _raise(self, node: ast.Raise) -> None:
        """Encode the kind of exception alone: its wording is not behaviour."""
        raised = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
        self._several("Raise", [] if raised is None else [raised])

    def _assert(self, node: ast.Assert) -> None:
        self._several("Assert", [node.test])

    def _expression(self, node: ast.Expr) -> None:
        if not does_nothing(node):
            self._generic(node)

    def _call(self, node: ast.Call) -> None:
        data = self._data.joined_by(node)
        if data is None:
            self._generic(node)
            data = self._data.found_by(node)
        if data is not None:
            self.text(f"(data {data})")

    def _nothing(self, node: ast.AST) -> None:
        """Leave out ``pass``, ``global`` and ``nonlocal``: the scopes have read them."""

    def _generic(self, node: ast.AST) -> None:
        self.text(f"({type(node).__name__}")
        for name in node._fields:
            value = getattr(node, name, None)
            if name in IGNORED or value is None or value == []:
                continue
            self.text(f" {name}=")
            self._value(node, name, value)
        self.text(")")

    def _value(self, node: ast.AST, name: str, value: object) -> None:
        if isinstance(value, ast.AST):
            self.node(value)
        elif isinstance(value, list):
            self.text("[")
            for each in value:
                self._value(node, name, each)
                self.text(",")
            self.text("]")
        elif isinstance(value, str) and name == NAMING.get(type(node)):
            self._name(value, ast.Store())
        else:
            self.text(repr(value))

    def _several(self, kind: str, nodes: Iterable[ast.AST]) -> None:
        self.text(f"({kind}")
        for each in nodes:
            self.node(each)
        self.text(")")

    # Names

    def _name(self, name: str, context: ast.expr_context) -> None:
        if not self._scopes and not isinstance(context, ast.Load) and name in self._stored:
            self.text(f"(bound {self._stored.index(name)})")
        else:
            self._pieces.append(self._found(name))

    def _found(self, name: str) -> Piece:
        """Return the meaning of a name here."""
        local = local_meaning(self._scopes, name)
        if isinstance(local, str):
            return local
        if local is not None:
            return self._resolve(local)
        if name == "__file__" and (data := self._data.all()) is not None:
            return f"(data {data})"
        return self._resolve(Target(self._module.name, name))

    def _attribute(self, node: ast.Attribute) -> None:
        base, names = _dotted(node)
        if isinstance(base, ast.Name):
            found, names = self._dotted_meaning(base, names)
            self._pieces.append(found)
        else:
            self.node(base)
        self.text("".join(f".{name}" for name in names))

    def _meaning(self, node: ast.expr) -> Piece | None:
        """Return the meaning of a plain or dotted name; None for anything else."""
        base, names = _dotted(node)
        if not isinstance(base, ast.Name):
            return None
        found, left = self._dotted_meaning(base, names)
        return None if left else found

    def _dotted_meaning(self, base: ast.Name, names: list[str]) -> tuple[Piece, list[str]]:
        """Return the meaning of ``base.name.name``, and the names that remain its attributes."""
        found = self._found(base.id)
        while names and isinstance(found, Reference) and found.name == "*":
            found = self._resolve(Target(found.module, names[0]))
            names = names[1:]
        if isinstance(found, str) and found.startswith("<"):
            # Makes ``np.pi`` and ``from numpy import pi`` equal.
            return f"<{'.'.join([found[1:-1], *names])}>", []
        return found, names

    def _import(self, node: Import) -> None:
        """Encode an import of a name that is bound elsewhere too, as in a ``try``."""
        for name, target in self._module.targets(node):
            if self._scopes and name in self._scopes[-1].imports:
                continue
            self._name(name, ast.Store())
            self.text("(Import ")
            self._pieces.append(self._resolve(target))
            self.text(")")

    # Scopes

    def _function(self, node: Function | ast.Lambda) -> None:
        self.text(f"({type(node).__name__}")
        if not isinstance(node, ast.Lambda):
            self._defined(node.name)
            self._several("decorators", node.decorator_list)
            self._several("types", getattr(node, "type_params", []))
        arguments = node.args
        self._several("defaults", arguments.defaults)
        for each in arguments.kw_defaults:
            self._several("default", [] if each is None else [each])
        named = [
            [each.arg for each in group if each is not None]
            for group in (
                arguments.posonlyargs,
                arguments.args,
                [arguments.vararg],
                arguments.kwonlyargs,
                [arguments.kwarg],
            )
        ]
        self.text(repr(named))
        body = [node.body] if isinstance(node, ast.Lambda) else node.body
        parameters = [name for group in named for name in group]
        self._scopes.append(body_scope("function", parameters, body, self._module))
        self._several("body", body)
        self._scopes.pop()
        self.text(")")

    def _class(self, node: ast.ClassDef) -> None:
        self.text("(ClassDef")
        self._defined(node.name)
        self._several("decorators", node.decorator_list)
        self._several("types", getattr(node, "type_params", []))
        self._several("bases", node.bases)
        self._several("keywords", node.keywords)
        self._scopes.append(body_scope("class", [], node.body, self._module))
        self._several("body", _ordered(node.body))
        self._scopes.pop()
        self.text(")")

    def _defined(self, name: str) -> None:
        """Encode the name of a function or class that is not at the top level."""
        if self._scopes:
            self._name(name, ast.Store())

    def _comprehension(self, node: Comprehension) -> None:
        self.text(f"({type(node).__name__}")
        for i, each in enumerate(node.generators):
            self.node(each.iter)
            if i == 0:  # The first iterable alone is evaluated outside.
                self._scopes.append(comprehension_scope(node.generators))
            self.text(f" {each.is_async}")
            self.node(each.target)
            self._several("ifs", each.ifs)
        parts = [node.key, node.value] if isinstance(node, ast.DictComp) else [node.elt]
        self._several("element", parts)
        self._scopes.pop()
        self.text(")")

    # Annotations

    def _annotated(self, node: ast.AnnAssign) -> None:
        of_class = bool(self._scopes) and self._scopes[-1].kind == "class"
        if not of_class:
            if node.value is not None:
                self._generic(ast.Assign(targets=[node.target], value=node.value))
            return
        self._several("Field", [node.target, *([] if node.value is None else [node.value])])
        self._annotation(node.annotation)

    def _annotation(self, node: ast.AST) -> None:
        """Encode the annotation of a field; our own classes all count as one."""
        match node:
            case ast.Name() | ast.Attribute():
                before = len(self._pieces)
                self.node(node)
                ours = any(isinstance(each, Reference) for each in self._pieces[before:])
                if ours:
                    self._pieces[before:] = ["<own>"]
            case ast.Subscript(value=ast.Name(id="Literal")):
                self.text("<literal>")
            case ast.Constant(value=str() as quoted):
                self._annotation(_parsed(quoted))
            case ast.Constant() | ast.expr_context() | ast.operator():
                self._generic(node)
            case _:
                self.text(f"({type(node).__name__}")
                for each in ast.iter_child_nodes(node):
                    self._annotation(each)
                self.text(")")


_SPECIAL: Final[dict[type[ast.AST], Callable[..., None]]] = {
    ast.AnnAssign: _Encoder._annotated,
    ast.Assert: _Encoder._assert,
    ast.AsyncFunctionDef: _Encoder._function,
    ast.Attribute: _Encoder._attribute,
    ast.Call: _Encoder._call,
    ast.ClassDef: _Encoder._class,
    ast.Constant: _Encoder._constant,
    ast.DictComp: _Encoder._comprehension,
    ast.Expr: _Encoder._expression,
    ast.FunctionDef: _Encoder._function,
    ast.GeneratorExp: _Encoder._comprehension,
    ast.Global: _Encoder._nothing,
    ast.Import: _Encoder._import,
    ast.ImportFrom: _Encoder._import,
    ast.Lambda: _Encoder._function,
    ast.ListComp: _Encoder._comprehension,
    ast.Name: _Encoder._named,
    ast.Nonlocal: _Encoder._nothing,
    ast.Pass: _Encoder._nothing,
    ast.Raise: _Encoder._raise,
    ast.SetComp: _Encoder._comprehension,
}
"""Encoders of the nodes that are not encoded field by field."""


def _dotted(node: ast.expr) -> tuple[ast.expr, list[str]]:
    """Return the base of nested attributes, and the names after it."""
    names: list[str] = []
    while isinstance(node, ast.Attribute):
        names.insert(0, node.attr)
        node = node.value
    return node, names


def _parsed(quoted: str) -> ast.AST:
    """Return a quoted annotation as it would be without quotes."""
    return ast.parse(quoted, mode="eval").body


def _ordered(body: Sequence[ast.stmt]) -> list[ast.stmt]:
    """Return a class's body with its methods last and by name, unless their order matters."""
    methods = [each for each in body if isinstance(each, Function)]
    names = [each.name for each in methods]
    others = [each for each in body if not isinstance(each, Function)]
    used = {each.id for node in others for each in ast.walk(node) if isinstance(each, ast.Name)}
    if len(set(names)) < len(names) or used & set(names):
        return list(body)
    return others + sorted(methods, key=lambda each: each.name)
