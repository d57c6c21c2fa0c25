"""From what a user types to a policy."""

import hashlib
import importlib
import importlib.util
import inspect
import sys
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import cast

from ..agent import Agent
from ..errors import InputError
from ..registry import POLICIES, lookup


@dataclass(frozen=True, kw_only=True)
class PolicySpec:
    """Where a policy's class is: picklable, so that any worker process can load it."""

    text: str
    """``name``, ``package.module:Class`` or ``path/to/file.py:Class``."""

    @property
    def name(self) -> str:
        """The name for tables: a registered name, or the class."""
        return self.text.rpartition(":")[2]

    def load(self) -> type[Agent]:
        """Return the policy's class.

        Raises
        ------
        InputError
            If there is no such policy, or the class is not one.
        """
        source, colon, name = self.text.rpartition(":")
        if not colon:
            if Path(self.text).suffix == ".py" or "/" in self.text:
                raise InputError(f"which class of {self.text}? Say {self.text}:Class")
            return _checked(lookup(POLICIES, self.text), self.text)
        module = _from_file(Path(source)) if source.endswith(".py") else _from_module(source)
        if not hasattr(module, name):
            raise InputError(f"{source} has no class {name!r}{_listing(module)}")
        return _checked(getattr(module, name), self.text)

    def check(self) -> None:
        """Raise an InputError, as :meth:`load`, if there is no such policy."""
        self.load()

    def digest(self) -> str:
        """Return the SHA-256 (16 hexadecimal digits) of the source file of the policy's class.

        Raises
        ------
        InputError
            As :meth:`load`.
        """
        return source_digest(self.load())

    def make(self) -> Agent:
        """Return a new policy object.

        Raises
        ------
        InputError
            As :meth:`load`, or if the class needs arguments.
        """
        return self.load()()


def source_digest(agent: type) -> str:
    """Return the SHA-256 (16 hexadecimal digits) of the source file of a class."""
    source = inspect.getsourcefile(agent)
    content = Path(source).read_bytes() if source else b""
    return hashlib.sha256(content).hexdigest()[:16]


def _from_module(name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except (Exception, SystemExit) as error:
        told = f"{type(error).__name__}: {error}"
        raise InputError(f"cannot import module {name!r}: {told}") from error


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
        raise InputError(f"{path} fails on import: {type(error).__name__}: {error}") from error
    return module


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
        raise InputError(f"{text} is abstract: name a class that can be made")
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
