"""A submission that runs without isolation."""

import contextlib
import importlib
import sys
import threading
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from colift.agents.agent import Agent
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.protocol import OURS
from colift.agents.spec import InProcess

_importing: Final = threading.Lock()
"""The import path and the working directory are shared by all threads."""


@dataclass(frozen=True, kw_only=True)
class TrustedSubmission(InProcess):
    """A submission whose policy acts in this process, with a new object for each episode.

    While the policy is made, its folder is the working directory and comes first on the import
    path. Then its modules are forgotten, so that the next submission cannot import them.
    """

    name: str
    folder: Path
    entry_point: str
    """``module:Class``, with the module in the folder."""
    source_digest: str
    parameters: str = ""
    """Parameters of the class: ``parameter=value,parameter=value``."""

    @property
    def files(self) -> Path:
        """The folder."""
        return self.folder

    @property
    def module(self) -> str:
        """Empty: all code is in the folder."""
        return ""

    def moved(self, folder: Path) -> "TrustedSubmission":
        """Return the same submission in another folder."""
        return replace(self, folder=folder)

    def digest(self) -> str:
        """Return the hash of the folder."""
        return self.source_digest

    def check(self) -> None:
        """Raise an InputError if its class cannot be loaded, or has no such parameter."""
        with self._imports():
            self._spec.check()

    def make(self) -> Agent:
        """Return a new policy object."""
        with self._imports():
            return self._spec.make()

    def _imports(self) -> AbstractContextManager[None]:
        """Return the context of its modules: a network's folder has none."""
        own = self.entry_point.startswith(OURS)
        return contextlib.chdir(self.folder) if own else _imports_from(self.folder)

    @property
    def _spec(self) -> PolicySpec:
        comma = "," if self.parameters else ""
        return PolicySpec(text=f"{self.entry_point}{comma}{self.parameters}")


@contextmanager
def _imports_from(folder: Path) -> Iterator[None]:
    """Import from a folder first, and forget its modules at the end."""
    with _importing, contextlib.chdir(folder):
        before, writes = sys.path[:], sys.dont_write_bytecode
        sys.path.insert(0, str(folder))
        sys.dont_write_bytecode = True
        importlib.invalidate_caches()
        try:
            yield
        finally:
            sys.path[:], sys.dont_write_bytecode = before, writes
            for name, module in list(sys.modules.items()):
                if str(getattr(module, "__file__", None) or "").startswith(f"{folder}/"):
                    del sys.modules[name]
