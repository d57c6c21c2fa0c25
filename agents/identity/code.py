"""Hashes of code: the behaviour of definitions and of all that they use, whatever the names."""

import ast
import builtins
import functools
import gc
import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, Final

from colift.agents.identity.encoding import Piece, encoded
from colift.agents.identity.modules import EFFECTS, Module, Reference, Target, read_module

DIGITS: Final = 16
"""Hexadecimal digits of a hash."""

WHOLE: Final = "*"
"""The name under which a module itself is referred to."""

ROUNDS: Final = 4
"""Rounds in which a module's definitions are distinguished by those they use, to order them."""

COLIFT: Final = __name__.partition(".")[0]

Root = type | Callable[..., Any] | ModuleType | tuple[ModuleType, str]
"""A class, a function, all that a module defines, or a module and the name of a constant in it."""


class Code:
    """The sources of some packages, as a graph of definitions that use each other.

    Only definitions that are reached are read.

    Parameters
    ----------
    packages
        Names of the packages, or of modules outside any package; definitions of others enter by
        their names.
    changed
        Sources to take instead of files, by the full names of their modules.
    """

    def __init__(
        self, packages: Iterable[str] = (COLIFT,), changed: Mapping[str, str | bytes] | None = None
    ) -> None:
        self._packages = frozenset(packages)
        self._modules: dict[str, Module | None] = {}
        self._encoded: dict[Reference, tuple[Piece, ...]] = {}
        for name, text in (changed or {}).items():
            self._modules[name] = self._replaced(name, ast.parse(text))

    def with_tree(self, name: str, tree: ast.Module) -> "Code":
        """Return the same with another source of a module that defines and imports the same names.

        All other modules are shared, which makes this cheap.
        """
        other = Code(self._packages)
        other._modules = {**self._modules, name: self._replaced(name, tree)}
        other._encoded = {ref: each for ref, each in self._encoded.items() if ref.module != name}
        return other

    def hash(self, *roots: Root, without: Iterable[Root] = ()) -> str:
        """Return the hash of the roots' behaviour, with all that they use, directly or not.

        Definitions are numbered as they are reached. So the hash stays the same when something is
        renamed, moved to another place or another module, or when something is added that the
        roots do not use.

        Parameters
        ----------
        roots
            Definitions to begin with; their order counts. One whose source is not known enters by
            its name.
        without
            Definitions that are not followed, since their values are stated elsewhere. One
            definition may occur under several names.
        """
        return self._hash([self._root(root) for root in roots], without)[0]

    def definitions(self, *roots: Root, without: Iterable[Root] = ()) -> tuple[Reference, ...]:
        """Return every definition that the roots use, themselves among them."""
        return self._hash([self._root(root) for root in roots], without)[1]

    def module_hash(self, name: str) -> str:
        """Return the hash of all that a module defines, in any order, and of all that this uses.

        Raises
        ------
        LookupError
            If there is no source of that name.
        """
        if self._module(name) is None:
            raise LookupError(f"no source of {name}")
        return self._hash([Reference(name, WHOLE)])[0]

    def _root(self, root: Root) -> Piece:
        if isinstance(root, ModuleType):
            return self._resolved(Target(root.__name__, None))
        if isinstance(root, tuple):
            return self._resolved(Target(root[0].__name__, root[1]))
        return self._resolved(Target(root.__module__, root.__qualname__.partition(".")[0]))

    def _hash(
        self, roots: Iterable[Piece], without: Iterable[Root] = ()
    ) -> tuple[str, tuple[Reference, ...]]:
        stated = {piece: i for i, piece in enumerate(dict.fromkeys(map(self._root, without)))}
        numbers: dict[Reference, int] = {}
        queue: list[Reference] = []

        def numbered(piece: Piece) -> str:
            if isinstance(piece, str):
                return piece
            if piece in stated:
                return f"(stated {stated[piece]})"
            if piece not in numbers:
                numbers[piece] = len(numbers)
                queue.append(piece)
            return f"(definition {numbers[piece]})"

        texts = ["".join(numbered(root) for root in roots)]
        for reference in queue:  # It grows meanwhile.
            pieces = self._pieces(reference)
            if reference.name not in (EFFECTS, WHOLE):
                pieces = (*pieces, *self._effects(reference.module))
            texts.append("".join(numbered(piece) for piece in pieces))
        return _short("\n".join(texts)), tuple(queue)

    def _pieces(self, reference: Reference) -> tuple[Piece, ...]:
        if reference not in self._encoded:
            module = self._module(reference.module)
            assert module is not None, reference
            if reference.name == WHOLE:
                each = [Reference(module.name, name) for name in module.definitions]
                self._encoded[reference] = tuple(self._sorted(each))
            else:
                definition = module.definitions[reference.name]
                self._encoded[reference] = encoded(definition, module, self._resolved, self._folder)
        return self._encoded[reference]

    def _sorted(self, references: Iterable[Reference]) -> list[Reference]:
        """Return definitions in an order that does not depend on their names and places."""
        signatures = dict.fromkeys(references, "")
        for _ in range(ROUNDS):
            signatures = {
                each: _short(
                    "".join(
                        piece if isinstance(piece, str) else signatures.get(piece, "(definition)")
                        for piece in self._pieces(each)
                    )
                )
                for each in signatures
            }
        return sorted(signatures, key=lambda each: signatures[each])

    def _effects(self, name: str) -> Iterator[Reference]:
        """Yield the loose statements that importing a module runs: its packages', then its own.

        Those of colift's top package are left out: they enter its environments into Gymnasium's
        registry, which changes no score.
        """
        parts = name.split(".")
        for i in range(1, len(parts) + 1):
            module = self._module(".".join(parts[:i]))
            if module is not None and module.name != COLIFT and EFFECTS in module.definitions:
                yield Reference(module.name, EFFECTS)

    def _resolved(self, target: Target) -> Piece:
        """Return the definition that a name in a module stands for, or a text."""
        seen: set[Target] = set()
        while target not in seen:
            seen.add(target)
            name = target.name
            module = self._module(target.module)
            if module is not None and name is None:
                return Reference(target.module, WHOLE)
            if module is not None and name in module.definitions:
                return Reference(target.module, name)
            if module is not None and name in module.imports:
                target = module.imports[name]
            elif name and self._module(f"{target.module}.{name}") is not None:
                target = Target(f"{target.module}.{name}", None)
            elif module is None or name is None:
                return f"<{target.module}>" if name is None else f"<{target.module}.{name}>"
            else:
                return self._unbound(module, name)
        return f"<{target.module}.{target.name}>"

    def _unbound(self, module: Module, name: str) -> Piece:
        """Return the meaning of a name that a module does not bind visibly."""
        for star in module.stars:
            source = self._module(star)
            if source is None:
                if not hasattr(builtins, name):
                    return f"<{star}.{name}>"
            elif name in source.definitions or name in source.imports:
                return self._resolved(Target(star, name))
        if "__getattr__" in module.definitions and not name.startswith("__"):
            return Reference(module.name, "__getattr__")
        return f"<builtins.{name}>"

    def _module(self, name: str) -> Module | None:
        if name not in self._modules:
            ours = name.partition(".")[0] in self._packages
            self._modules[name] = read_module(name) if ours else None
        return self._modules[name]

    def _folder(self, name: str) -> Path | None:
        """Return the folder of a module of colift; None for others, which lie among any files."""
        module = self._module(name) if name.partition(".")[0] == COLIFT else None
        return None if module is None else module.folder

    def _replaced(self, name: str, tree: ast.Module) -> Module:
        package = name.rpartition(".")[0]
        there = self._modules.get(name) or read_module(name)
        beside = there or (read_module(package) if package else None)
        folder = None if beside is None else beside.folder
        return there.with_tree(tree) if there else Module(name, tree, package, folder)


@functools.cache
def code_hash(*roots: Root, without: tuple[Root, ...] = ()) -> str:
    """Return the hash of the behaviour of functions, classes and constants; see :meth:`Code.hash`.

    It covers colift and the packages of the roots.
    """
    names = {each.__name__ if isinstance(each, ModuleType) else _home(each) for each in roots}
    packages = {COLIFT, *(name.partition(".")[0] for name in names)}
    with _no_collection():
        return _code(frozenset(packages)).hash(*roots, without=without)


@contextmanager
def _no_collection() -> Iterator[None]:
    """Suspend the garbage collector: walking over growing syntax trees takes half of the time."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


@functools.cache
def _code(packages: frozenset[str]) -> Code:
    return Code(packages)


def _home(root: Root) -> str:
    return root[0].__name__ if isinstance(root, tuple) else str(root.__module__)


def source_hash(source: bytes) -> str:
    """Return the hash of a source file's behaviour, and of all that it uses of colift.

    All its definitions count; imports from elsewhere enter by their names. A file that is not
    valid Python is hashed byte by byte.
    """
    name = "a source by itself"
    try:
        return Code((COLIFT,), {name: source}).module_hash(name)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return hashlib.sha256(source).hexdigest()[:DIGITS]


def _short(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:DIGITS]
