"""Hashes of code: the behaviour of definitions and of all that they use, whatever the names."""

import ast
import builtins
import functools
import gc
import hashlib
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from importlib import import_module
from typing import Any, Final

from colift.base.identity.data import data_hash
from colift.base.identity.modules import EFFECTS, Module, Reference, read_module
from colift.base.identity.statements import Statement, Target, Use
from colift.base.identity.values import value_text

WHOLE: Final = "*"
"""The name under which a module itself is referred to."""

COLIFT: Final = __name__.partition(".")[0]

FINDERS: Final = {
    *(f"<builtins.__{name}__>" for name in ("file", "path", "spec", "loader")),
    *(f"<importlib.resources.{name}>" for name in ("files", "open_binary", "open_text", "path")),
    *("<importlib.resources.read_binary>", "<importlib.resources.read_text>", "<pkgutil.get_data>"),
}
"""How code finds the files beside it."""

Root = type | Callable[..., Any] | Reference
"""A class, a function, or the module and the name of a definition."""

Piece = str | Reference


class Code:
    """The sources of some packages, as a graph of definitions that use each other.

    Only modules with definitions that are reached are read.

    Parameters
    ----------
    packages
        Names of the packages, or of modules outside any package; definitions of others enter by
        their names.
    modules
        Modules to take instead of those of these names.
    """

    def __init__(
        self, packages: Iterable[str] = (COLIFT,), modules: Mapping[str, Module] | None = None
    ) -> None:
        self._packages = frozenset(packages)
        self.modules: dict[str, Module | None] = {**(modules or {})}
        self._found: dict[Target, Piece] = {}
        self._pieces: dict[Reference, list[Piece]] = {}
        self._valued: set[Reference] = set()
        """Definitions whose values count, as they are when a hash is asked for."""
        self._walks: dict[tuple[object, object], tuple[str, list[Reference]]] = {}

    def hash(self, *roots: Root, without: Iterable[object] = (), values: bool = False) -> str:
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
            Values of definitions that are not followed, since they are stated elsewhere.
        values
            Whether constants and attributes of classes count as they are now, too. Modules of
            colift that have some and that only functions import are imported.
        """
        key = roots, tuple(map(id, without))
        if key not in self._walks:
            self._walks[key] = self._walk(roots, without)
        text, used = self._walks[key]
        valued = [each for each in used if values and each in self._valued]
        for module in {each.module for each in valued} - sys.modules.keys():
            if module.startswith(f"{COLIFT}."):
                import_module(module)
        texts = [text, *(value_text(each.value()) for each in valued)]
        return hashlib.sha256("\n".join(texts).encode()).hexdigest()[:16]

    def definitions(self, *roots: Root, without: Iterable[object] = ()) -> list[Reference]:
        """Return every definition that the roots use, themselves among them."""
        return self._walk(roots, without)[1]

    def module(self, name: str) -> Module | None:
        """Return a module of the packages; None if no source of that name is known."""
        if name not in self.modules:
            top = name.partition(".")[0]
            if top in self._packages - {COLIFT}:
                with suppress(Exception):  # As a lift would; a module may raise anything.
                    import_module(name)
            self.modules[name] = read_module(name) if top in self._packages else None
        return self.modules[name]

    def _walk(
        self, roots: Iterable[Root], without: Iterable[object]
    ) -> tuple[str, list[Reference]]:
        stated = {id(value): f"(stated {i})" for i, value in enumerate(without)}
        numbers: dict[Reference, str] = {}
        queue: list[Reference] = []
        texts: list[str] = []

        def enter(pieces: Iterable[Piece]) -> None:
            for piece in pieces:
                if isinstance(piece, str):
                    texts.append(piece)
                    continue
                if piece not in numbers:
                    elsewhere = stated.get(id(piece.value()))
                    numbers[piece] = elsewhere or f"(definition {len(queue)})"
                    queue.extend([] if elsewhere else [piece])
                texts.append(numbers[piece])

        for root in roots:
            if not isinstance(root, Reference):
                root = Reference(root.__module__, root.__qualname__.partition(".")[0])
            enter([self._resolved(Target(*root))])
        for i, reference in enumerate(queue):  # It grows meanwhile.
            texts.append("(next)")
            enter(self._read(reference))
            if i + 1 == len(queue):
                for each in dict.fromkeys(each.module for each in queue):
                    enter(self._effects(each))
        return "\n".join(texts), queue

    def _read(self, reference: Reference) -> list[Piece]:
        """Return a definition as texts and references to other definitions."""
        if reference in self._pieces:
            return self._pieces[reference]
        module = self.module(reference.module)
        assert module is not None, reference
        pieces = self._pieces[reference] = []
        if reference.name == WHOLE:
            pieces += [Reference(module.name, name) for name in sorted(module.definitions)]
            return pieces
        statements = module.definitions[reference.name]
        for statement in statements:
            pieces.append("(statement)")
            for each in statement.pieces:
                if isinstance(each, str):
                    pieces.append(each)
                elif isinstance(each, Use):
                    pieces += self._meaning(each, statement, module, reference.name)
                else:
                    pieces.append(self._resolved(each))
        own = module.top == COLIFT
        if not FINDERS.isdisjoint(pieces):
            pieces.append(data_hash(module, statements, everything=not own))
        # What our own calls return, such as a file's number, may differ between processes.
        of_call = own and "Call" in {str(each)[:4] for each in pieces}
        is_class = any(isinstance(each.node, ast.ClassDef) for each in statements)
        if reference.name not in module.rebound and (not of_call or is_class):
            self._valued.add(reference)
        return pieces

    def _meaning(self, use: Use, statement: Statement, module: Module, of: str) -> list[Piece]:
        """Return what a name stands for in a definition: several things if that is not certain."""
        region, name = use.region, use.name
        if region is statement.top and use.stored and of != EFFECTS:
            return ["(this)" if name == of else f"(bound {region.numbers[name]})"]
        pieces: list[Piece] = []
        if region is not statement.top and name in region.stored:
            pieces = [f"(local {region.numbers[name]})", use.attributes]
        if use.stored and region.kind == "class":
            return pieces
        for target in region.imports.get(name, ()):
            pieces += self._dotted(target, use.attributes)
        known = name in module.definitions or name in module.imports
        if not pieces or (known and name in statement.outer):
            pieces += self._dotted(Target(module.name, name), use.attributes)
        return pieces

    def _dotted(self, target: Target, attributes: str) -> list[Piece]:
        """Return the definition that ``target.name.name`` stands for, and the attributes left."""
        found = self._resolved(target)
        while attributes and isinstance(found, Reference) and found.name == WHOLE:
            name, _, attributes = attributes.partition(".")
            found = self._resolved(Target(found.module, name))
        if isinstance(found, str):
            # Makes ``np.pi`` and ``from numpy import pi`` equal.
            return [f"{found[:-1]}.{attributes}>" if attributes else found]
        return [found, attributes]

    def _resolved(self, target: Target) -> Piece:
        if target not in self._found:
            self._found[target] = "<circular import>"
            self._found[target] = self._find(*target)
        return self._found[target]

    def _find(self, place: str, name: str | None) -> Piece:
        """Return the definition that a name in a module stands for, or a text."""
        module = self.module(place)
        if name is None:
            return Reference(place, WHOLE) if module else f"<{place}>"
        if module and name in module.definitions:
            return Reference(place, name)
        if module and name in module.imports:
            return self._resolved(module.imports[name])
        if (not module or module.package == place) and self.module(f"{place}.{name}"):
            return Reference(f"{place}.{name}", WHOLE)
        if module and "*" in module.imports and not hasattr(builtins, name):
            return self._resolved(Target(module.imports["*"].module, name))
        if module and "__getattr__" in module.definitions and not name.startswith("__"):
            return Reference(place, "__getattr__")
        return f"<{'builtins' if module else place}.{name}>"

    def _effects(self, name: str) -> Iterator[Reference]:
        """Yield the loose statements that importing a module runs.

        They are those of its packages and its own; in other packages than colift also those of the
        modules that it imports. Those of colift's top package are left out: they enter its
        environments into Gymnasium's registry, which changes no score.
        """
        queue = [name]
        for each in queue:  # It grows meanwhile.
            module = self.module(each)
            if module is None or each == COLIFT:
                continue
            if EFFECTS in module.definitions:
                yield Reference(each, EFFECTS)
            used = () if module.top == COLIFT else module.imports.values()
            others = [each.rpartition(".")[0], *(t.module for t in used)]
            others += [f"{t.module}.{t.name}" for t in used]
            queue += [other for other in others if other not in queue]


@functools.cache
def _code(packages: frozenset[str]) -> Code:
    return Code(packages)


def code_hash(*roots: Root, without: Iterable[object] = (), values: bool = False) -> str:
    """Return the hash of the behaviour of functions and classes; see :meth:`Code.hash`.

    It covers colift and the packages of the roots.
    """
    modules = (each[0] if isinstance(each, Reference) else each.__module__ for each in roots)
    packages = {COLIFT, *(each.partition(".")[0] for each in modules)}
    collects = gc.isenabled()
    gc.disable()  # Its walks over growing syntax trees take a quarter of the time.
    try:
        return _code(frozenset(packages)).hash(*roots, without=without, values=values)
    finally:
        if collects:
            gc.enable()


def source_hash(source: bytes) -> str:
    """Return the hash of a source file's behaviour, and of all that it uses of colift.

    All its definitions count, in any order; imports from elsewhere enter by their names. A file
    that is not valid Python is hashed byte by byte.
    """
    try:
        module = Module("a source by itself", source, "")
        code = Code((COLIFT,), {module.name: module})
        every = (Reference(module.name, each) for each in module.definitions)
        return code.hash(*sorted(every, key=code.hash))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return hashlib.sha256(source).hexdigest()[:16]
