"""A definition as text without names, places and words: what is left is what it does."""

import ast
import hashlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Literal

from .modules import (
    NAMING,
    Comprehension,
    Definition,
    Function,
    Import,
    Module,
    Reference,
    Target,
    binds,
    bound_names,
    does_nothing,
    scope_nodes,
)

Piece = str | Reference
Resolve = Callable[[Target], Piece]
"""Returns the definition that a target stands for, or a text for what is not our own."""

IGNORED: Final = frozenset({"ctx", "kind", "returns", "type_comment", "type_ignores"})
"""Fields of syntax trees that do nothing, or are said by another field too."""

DATA: Final = "importlib.resources.files"
"""What finds data files: ``files(__package__).joinpath("data", "file.json")`` stands for that
file's content, and so does a package in the place of ``__package__``. Of any other place, and where
our own code asks for its ``__file__``, all data files below count."""


@dataclass
class _Scope:
    """The names of a function, a class or a comprehension."""

    kind: Literal["function", "class", "comprehension"]
    names: dict[str, int]
    imports: dict[str, Target] = field(default_factory=dict)
    globals: frozenset[str] = frozenset()


def encoded(
    definition: Definition,
    module: Module,
    resolve: Resolve,
    folder_of: Callable[[str], Path | None],
) -> tuple[Piece, ...]:
    """Return a definition as texts and references to other definitions.

    Left out are comments, docstrings, positions, annotations (but those of a class's body, which
    may declare fields), and what an exception is raised with. Local variables are numbered.

    Parameters
    ----------
    definition, module
        The definition, and the module that it is in.
    resolve
        Returns what a global name stands for.
    folder_of
        Returns where one of our own modules lies, for its data files.
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
        self._folder_of = folder_of
        self._pieces: list[Piece] = []
        self._scopes: list[_Scope] = []
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
        """Encode what kind of exception is raised; with what words is not behaviour."""
        raised = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
        self._several("Raise", [] if raised is None else [raised])

    def _assert(self, node: ast.Assert) -> None:
        self._several("Assert", [node.test])

    def _expression(self, node: ast.Expr) -> None:
        if not does_nothing(node):
            self._generic(node)

    def _call(self, node: ast.Call) -> None:
        content = self._data(node)
        if content is None:
            self._generic(node)
            folder = self._folder_of(self._module.name)
            if folder is not None and self._names(node.func, DATA):
                self.text(f"(data {_content(_all(folder))})")
        else:
            self.text(f"(data {content})")

    def _nothing(self, node: ast.AST) -> None:
        """Encode what only says which scope a name is of, or that there is nothing to do."""

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
        """Return what a name stands for here."""
        innermost = len(self._scopes) - 1
        for depth in range(innermost, -1, -1):
            scope = self._scopes[depth]
            if scope.kind == "class" and depth != innermost:
                continue
            if name in scope.globals:
                break
            if name in scope.imports:
                return self._resolve(scope.imports[name])
            if name in scope.names:
                # Those of a class are attributes.
                local = name if scope.kind == "class" else scope.names[name]
                return f"(local {depth} {local})"
        if name == "__file__" and (folder := self._folder_of(self._module.name)):
            return f"(data {_content(_all(folder))})"
        return self._resolve(Target(self._module.name, name))

    def _attribute(self, node: ast.Attribute) -> None:
        names: list[str] = []
        base: ast.expr = node
        while isinstance(base, ast.Attribute):
            names.insert(0, base.attr)
            base = base.value
        if not isinstance(base, ast.Name):
            self.node(base)
        else:
            found = self._found(base.id)
            while names and isinstance(found, Reference) and found.name == "*":
                found = self._resolve(Target(found.module, names.pop(0)))
            if isinstance(found, str) and found.startswith("<"):
                # So that ``np.pi`` and ``from numpy import pi`` are one.
                found = f"<{'.'.join([found[1:-1], *names])}>"
                names = []
            self._pieces.append(found)
        self.text("".join(f".{name}" for name in names))

    def _import(self, node: Import) -> None:
        """Encode an import that is more than one of a name: in a ``try``, or one of several."""
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
        self._enter("function", [name for group in named for name in group], body)
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
        self._enter("class", [], node.body)
        self._several("body", _ordered(node.body))
        self._scopes.pop()
        self.text(")")

    def _defined(self, name: str) -> None:
        """Encode the name of a function or class: of one at the top level there is none."""
        if self._scopes:
            self._name(name, ast.Store())

    def _comprehension(self, node: Comprehension) -> None:
        self.text(f"({type(node).__name__}")
        for i, each in enumerate(node.generators):
            if i:
                self.node(each.iter)
            else:
                # The first one is evaluated outside.
                self.node(each.iter)
                targets = [generator.target for generator in node.generators]
                self._scopes.append(_Scope("comprehension", _numbered(bound_names(targets))))
            self.text(f" {each.is_async}")
            self.node(each.target)
            self._several("ifs", each.ifs)
        parts = [node.key, node.value] if isinstance(node, ast.DictComp) else [node.elt]
        self._several("element", parts)
        self._scopes.pop()
        self.text(")")

    def _enter(
        self, kind: Literal["function", "class"], names: list[str], body: Sequence[ast.AST]
    ) -> None:
        inside = scope_nodes(body)
        outer = {n for each in inside if isinstance(each, ast.Nonlocal) for n in each.names}
        of_module = {n for each in inside if isinstance(each, ast.Global) for n in each.names}
        bound = [*names, *(name for each in inside for name in binds(each))]
        imports = {
            name: target
            for each in inside
            if isinstance(each, Import)
            for name, target in self._module.targets(each)
            if bound.count(name) == 1
        }
        left = [name for name in bound if name not in {*outer, *of_module, *imports}]
        self._scopes.append(_Scope(kind, _numbered(left), imports, frozenset(of_module)))

    # What is read otherwise

    def _annotated(self, node: ast.AnnAssign) -> None:
        of_class = bool(self._scopes) and self._scopes[-1].kind == "class"
        if not of_class:
            if node.value is not None:
                self._generic(ast.Assign(targets=[node.target], value=node.value))
            return
        self._several("Field", [node.target, *([] if node.value is None else [node.value])])
        self._annotation(node.annotation)

    def _annotation(self, node: ast.AST) -> None:
        """Encode the annotation of a field: of our own classes only that it is one of them."""
        match node:
            case ast.Name() | ast.Attribute():
                before = len(self._pieces)
                self.node(node)
                ours = any(isinstance(each, Reference) for each in self._pieces[before:])
                if ours:
                    self._pieces[before:] = ["<own>"]
            case ast.Constant(value=str()):
                self.text("<forward>")
            case ast.Constant() | ast.expr_context() | ast.operator():
                self._generic(node)
            case _:
                self.text(f"({type(node).__name__}")
                for each in ast.iter_child_nodes(node):
                    self._annotation(each)
                self.text(")")

    def _data(self, node: ast.Call) -> str | None:
        """Return the hash of the data file that a call finds; None if it is no such call."""
        match node:
            case ast.Call(
                func=ast.Attribute(value=ast.Call(func=finder, args=[place]), attr="joinpath"),
                args=parts,
            ) if parts and self._names(finder, DATA):
                folder = self._folder(place)
            case _:
                return None
        if folder is None:
            return None
        names = [str(each.value) for each in parts if isinstance(each, ast.Constant)]
        return _content([folder.joinpath(*names)] if len(names) == len(parts) else _all(folder))

    def _folder(self, place: ast.expr) -> Path | None:
        """Return where a package of colift lies; None of other places."""
        match place:
            case ast.Name(id="__package__"):
                return self._folder_of(self._module.name)
            case ast.Constant(value=str(name)):
                return self._folder_of(name)
            case ast.Name(id=name):
                found = self._found(name)
                return self._folder_of(found.module) if isinstance(found, Reference) else None
        return None

    def _names(self, node: ast.expr, wanted: str) -> bool:
        before = len(self._pieces)
        if isinstance(node, ast.Name | ast.Attribute):
            self.node(node)
        found = self._pieces[before:]
        del self._pieces[before:]
        return "".join(each for each in found if isinstance(each, str)) == f"<{wanted}>"


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
"""The nodes that are not encoded field by field."""


def _numbered(names: Iterable[str]) -> dict[str, int]:
    return {name: i for i, name in enumerate(dict.fromkeys(names))}


def _ordered(body: Sequence[ast.stmt]) -> list[ast.stmt]:
    """Return a class's body with its methods last and by name, where order says nothing."""
    methods = [each for each in body if isinstance(each, Function)]
    names = [each.name for each in methods]
    others = [each for each in body if not isinstance(each, Function)]
    used = {each.id for node in others for each in ast.walk(node) if isinstance(each, ast.Name)}
    if len(set(names)) < len(names) or used & set(names):
        return list(body)
    return others + sorted(methods, key=lambda each: each.name)


def _content(paths: Iterable[Path]) -> str:
    """Return the hash of what files hold."""
    sha = hashlib.sha256()
    for path in paths:
        sha.update(hashlib.sha256(path.read_bytes()).digest())
    return sha.hexdigest()


def _all(folder: Path) -> list[Path]:
    """Return every data file of a package, where the code does not say which one it reads."""
    return sorted(
        path
        for path in folder.rglob("*")
        if path.is_file() and path.suffix not in (".py", ".pyc", ".typed")
    )
