"""Specifications of policies, made from the text that a user types."""

import hashlib
import importlib
import importlib.util
import inspect
import sys
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any, cast

from colift.agents.agent import Agent
from colift.agents.loading.parameters import make_with, read_values
from colift.agents.loading.policy_files import with_class
from colift.agents.spec import InProcess
from colift.base.errors import InputError
from colift.base.identity import code_hash, source_hash
from colift.base.registry import POLICIES, lookup
from colift.base.threads import one_thread


@dataclass(frozen=True, kw_only=True)
class PolicySpec(InProcess):
    """A policy as text: the place of its class, and its parameters; any process can load it."""

    text: str
    """``name``, ``package.module:Class`` or ``path/to/file.py:Class``; after a comma, parameters
    that differ from the default: ``name,parameter=value,parameter=value``."""

    @property
    def name(self) -> str:
        """The name for tables: a registered name or the class, and the parameters as given."""
        origin, comma, parameters = self.parts
        return origin.rpartition(":")[2] + comma + parameters

    def load(self) -> type[Agent]:
        """Return the policy's class.

        Raises
        ------
        InputError
            If there is no such policy, or the class is not one.
        """
        origin, _, _ = self.parts
        source, colon, name = origin.rpartition(":")
        if not colon:
            if Path(origin).suffix == ".py" or "/" in origin:
                raise InputError(f"{origin} names no class; give {with_class(Path(origin))}")
            return _checked(lookup(POLICIES, origin), origin)
        module = _from_file(Path(source)) if source.endswith(".py") else _from_module(source)
        if not hasattr(module, name):
            raise InputError(f"{source} has no class {name!r}{_listing(module)}")
        return _checked(getattr(module, name), origin)

    def check(self) -> None:
        """Raise an InputError, as :meth:`make`, if there is no such policy or parameter."""
        with one_thread():  # Imported code may compute.
            policy = self.load()
            if self._values(policy):
                self.make()

    def digest(self) -> str:
        """Return the hash of the policy's class (:func:`source_digest`) and its parameters.

        Parameters count by their values: ``0.5`` and ``.50`` give the same hash.

        Raises
        ------
        InputError
            As :meth:`load`, or if there is no such parameter.
        """
        policy = self.load()
        values = self._values(policy)
        if not values:
            return source_digest(policy)
        settings = ",".join(f"{name}={value!r}" for name, value in sorted(values.items()))
        return hashlib.sha256(f"{source_digest(policy)},{settings}".encode()).hexdigest()[:16]

    def make(self) -> Agent:
        """Return a new policy object.

        Raises
        ------
        InputError
            As :meth:`load`, if the class needs arguments, or refuses the parameters.
        """
        policy = self.load()
        values = self._values(policy)
        if not values:
            return policy()
        try:
            return cast(Agent, make_with(policy, values))
        except Exception as error:
            reason = error if isinstance(error, ValueError) else f"{type(error).__name__}: {error}"
            raise InputError(f"policy {self.parts[0]}: {reason}") from error

    @property
    def parts(self) -> tuple[str, str, str]:
        """The place of the class, a comma, and the parameters; the last two may be empty.

        Names and classes have no comma, but the path of a file may.
        """
        path, colon, rest = self.text.partition(".py:")
        if not colon:
            path, rest = "", self.text
        name, comma, parameters = rest.partition(",")
        return path + colon + name, comma, parameters

    @property
    def files(self) -> Path | None:
        """The policy's file; None if its class is in an installed module."""
        source, _, _ = self.parts[0].rpartition(":")
        return Path(source) if source.endswith(".py") else None

    @property
    def module(self) -> str:
        """Empty: :meth:`digest` reads the code of an installed module."""
        return ""

    def moved(self, folder: Path) -> "PolicySpec":
        """Return the same policy with its file in another folder."""
        origin, comma, parameters = self.parts
        source, _, name = origin.rpartition(":")
        return PolicySpec(text=f"{folder / Path(source).name}:{name}{comma}{parameters}")

    def _values(self, policy: type) -> dict[str, Any]:
        """Return the values of the parameters that are given, by name."""
        origin, comma, parameters = self.parts
        try:
            return read_values(policy, parameters) if comma else {}
        except InputError as error:
            raise InputError(f"policy {origin}: {error}") from error


@dataclass(frozen=True, kw_only=True)
class InMemorySpec(InProcess):
    """A policy made by a callable, such as one with an object as parameter."""

    name: str
    factory: Callable[[], Agent]
    """Makes a new agent; must be picklable, since it goes to worker processes."""
    source: type
    """The class whose code is hashed."""

    def check(self) -> None:
        """Do nothing: nothing has to be loaded."""

    def digest(self) -> str:
        """Return the hash of the class; see :func:`source_digest`."""
        return source_digest(self.source)

    def make(self) -> Agent:
        """Return a new agent."""
        return self.factory()


def source_digest(agent: type) -> str:
    """Return the hash of a class (16 hexadecimal digits), without names, comments and docstrings.

    For a class of colift it covers the class and everything it uses, learned and calibrated data
    included; for any other class, everything that its file defines.
    """
    if agent.__module__.partition(".")[0] == __name__.partition(".")[0]:
        return code_hash(agent)
    source = inspect.getsourcefile(agent)
    return source_hash(Path(source).read_bytes() if source else b"")


def _from_module(name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except (Exception, SystemExit) as error:
        raise InputError(f"cannot import module {name!r}: {_cause(error)}") from error


def _from_file(path: Path) -> ModuleType:
    if not path.is_file():
        raise InputError(f"no such file: {path}")
    name = f"colift_policy_{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise InputError(f"not a Python file: {path}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise InputError(f"{path} fails on import: {_cause(error)}") from error
    return module


def _cause(error: BaseException) -> str:
    """Return the error of an import, with file and line."""
    frames = traceback.extract_tb(error.__traceback__)
    places = [frame for frame in frames if not frame.filename.startswith(("<", __file__))]
    where = f" ({Path(places[-1].filename).name}, line {places[-1].lineno})" if places else ""
    return f"{type(error).__name__}: {error}{where}"


def _listing(module: ModuleType) -> str:
    classes = [
        name
        for name, value in vars(module).items()
        if inspect.isclass(value) and value.__module__ == module.__name__
    ]
    return f"; it has {', '.join(classes)}" if classes else ""


def _checked(policy: object, text: str) -> type[Agent]:
    if not inspect.isclass(policy):
        raise InputError(f"{text} is not a class")
    if inspect.isabstract(policy) or getattr(policy, "_is_protocol", False):
        raise InputError(f"{text} is abstract: name a concrete class")
    for method in ("reset", "act"):
        if not callable(getattr(policy, method, None)):
            raise InputError(f"policy {text} has no method {method}(); it needs reset and act")
    required = [
        parameter.name
        for parameter in inspect.signature(policy).parameters.values()
        if parameter.default is parameter.empty
        and parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    ]
    if required:
        raise InputError(
            f"policy {text} needs arguments: {', '.join(required)}; give them defaults"
        )
    return cast(type[Agent], policy)
