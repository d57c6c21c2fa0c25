"""A policy that runs in a sandbox: what a runner needs to know of it."""

import contextlib
import os
import threading
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from ..errors import InputError, PolicyError
from .ladder import describe, strongest
from .launch import BUBBLEWRAP
from .limits import LIMITS, Limits
from .remote import RemoteAgent, UnmadeAgent, remote_agent
from .sandbox import Sandbox, Work
from .view import AGENTS

KEPT: Final = 4
"""Sandboxes that a thread keeps running: those that it used last."""

_local = threading.local()


@dataclass(frozen=True, kw_only=True)
class SandboxedPolicy:
    """A policy in a sandbox, each episode in a fresh process; goes to worker processes.

    It is what a runner takes: see :class:`colift.benchmark.runner.AgentSpec`.
    """

    name: str
    """The policy's name, for tables."""
    place: str
    """Where its class is: ``module:Class``, or ``file.py:Class`` with a path that is absolute or
    relative to the folder."""
    parameters: str = ""
    """What is set of it: ``parameter=value,parameter=value``."""
    folder: Path | None = None
    """The submission's folder: seen read-only, and where the policy starts."""
    source_digest: str = ""
    """Hash of all that the policy is made of, parameters included."""
    preload: bool = False
    """Whether its module is imported once for all episodes, where that is possible."""
    rung: str | None = None
    """How it is isolated; None for the strongest way that works here."""
    limits: Limits = LIMITS
    """What it may use up in an episode."""
    size: int = 1
    """How many numbers its action is."""

    @property
    def isolation(self) -> str:
        """The rung of the ladder that is used."""
        return self.rung or strongest()

    @property
    def preloaded(self) -> bool:
        """Whether the episodes are forked from one process, and so have to be audited."""
        return self.preload and self.isolation == BUBBLEWRAP

    def with_rung(self, rung: str | None) -> "SandboxedPolicy":
        """Return the same policy, isolated in another way.

        Raises
        ------
        InputError
            If there is no such way.
        """
        if rung is not None:
            describe(rung)
        return replace(self, rung=rung)

    def digest(self) -> str:
        """Return the hash of the policy's source."""
        return self.source_digest

    def check(self) -> None:
        """Make the policy once, in its sandbox.

        Raises
        ------
        InputError
            If that fails.
        EvaluatorFault
            If there is no sandbox to be had.
        """
        with self.agent() as agent:
            if agent.failure is not None:
                raise InputError(f"policy {self.name}: {agent.failure}")

    @contextmanager
    def agent(self) -> Iterator[RemoteAgent | UnmadeAgent]:
        """Yield a new agent for one episode; its processes end with it.

        If the policy cannot be made, its ``reset`` says why.

        Raises
        ------
        EvaluatorFault
            If there is no sandbox to be had.
        """
        seen, work = self._seen()
        sandbox = _kept(self.isolation, seen, self.limits)
        try:
            connection = sandbox.preloaded(work) if self.preloaded else sandbox.episode(work)
        except PolicyError as error:
            yield UnmadeAgent(error, sandbox.imported)
            return
        with contextlib.closing(connection):
            agent = remote_agent(connection, self.limits, self.size)
            with contextlib.closing(agent):
                yield agent

    def _seen(self) -> tuple[Path | None, Work]:
        """Return the file or folder that the policy sees, and what is to be done with it."""
        file, colon, name = self.place.rpartition(":")
        seen, place = self.folder.resolve() if self.folder else None, self.place
        if seen is None and colon and file.endswith(".py"):
            seen = Path(file).resolve()
            place = f"{seen}:{name}"
        if seen is not None and (seen == AGENTS.parent or seen in AGENTS.parents):
            raise InputError(f"{seen} holds colift itself: put the policy into a folder of its own")
        return seen, Work(place=place, parameters=self.parameters, size=self.size)


def _kept(rung: str, seen: Path | None, limits: Limits) -> Sandbox:
    """Return this thread's sandbox, started if there is none."""
    if getattr(_local, "process", None) != os.getpid():
        _local.process, _local.sandboxes = os.getpid(), OrderedDict()
    kept: OrderedDict[object, Sandbox] = _local.sandboxes
    key = rung, seen, limits
    if key not in kept:
        kept[key] = Sandbox(rung, seen, limits)
    kept.move_to_end(key)
    while len(kept) > KEPT:
        kept.popitem(last=False)[1].close()
    return kept[key]


def close_sandboxes() -> None:
    """End the sandboxes that this thread keeps."""
    kept = getattr(_local, "sandboxes", {})
    while kept:
        kept.popitem()[1].close()
