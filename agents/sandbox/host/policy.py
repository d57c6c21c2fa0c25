"""The specification of a policy that runs in a sandbox."""

import atexit
import contextlib
import os
import threading
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

from colift.agents.loading.description import ParameterText
from colift.agents.sandbox.host.agent import RemoteAgent, remote_agent
from colift.agents.sandbox.host.levels import strongest
from colift.agents.sandbox.host.sandbox import Load, Sandbox
from colift.agents.sandbox.protocol import AGENTS, LIMITS, Assignment, Limits
from colift.base.errors import InputError, PolicyError

KEPT: Final = 4
"""Sandboxes that a thread keeps running: the most recently used."""

_local = threading.local()


@dataclass(frozen=True, kw_only=True)
class SandboxedPolicy:
    """A policy in a sandbox, each episode in a process of its own; can be sent to worker processes.

    It is a :class:`colift.agents.spec.AgentSpec`. Its methods raise EvaluatorFault if no sandbox
    can be started.
    """

    name: str
    """The policy's name, for tables."""
    origin: str
    """Place of its class: ``module:Class``, or ``file.py:Class`` with a path that is absolute or
    relative to the folder."""
    parameters: str = ""
    """Its parameters: ``parameter=value,parameter=value``."""
    folder: Path | None = None
    """The submission's folder: read-only, and the policy's working directory."""
    source_digest: str = ""
    """Hash of the policy's files and parameters."""
    instance: str = ""
    """Names an instance: another is loaded anew, in a process that has seen no lift of this one."""
    isolation: str = field(default_factory=strongest)
    """Its isolation level: chosen when the policy is named, and the same in all workers."""
    limits: Limits = LIMITS
    """Its budgets in an episode."""
    size: int = 1
    """Length of its actions."""

    @property
    def files(self) -> Path | None:
        """The submission's folder; None if the policy is in an installed module."""
        return self.folder

    @property
    def module(self) -> str:
        """The installed module that the policy is in; empty if it has a folder."""
        return "" if self.folder else self.origin.rpartition(":")[0]

    def moved(self, folder: Path) -> "SandboxedPolicy":
        """Return the same policy with its submission in another folder."""
        return replace(self, folder=folder)

    def paced(self, period: float, lifts: int = 1) -> "SandboxedPolicy":
        """Return the same policy with the budgets of a control period [s], and of many lifts."""
        cpu = self.limits.cpu_seconds * lifts
        return replace(self, limits=replace(self.limits, period=period, cpu_seconds=cpu))

    def digest(self) -> str:
        """Return the hash of the policy's source."""
        return self.source_digest

    def check(self) -> None:
        """Make the policy once, in its sandbox; raise InputError if that fails."""
        with self.agent() as agent:
            if agent.failure is not None:
                raise InputError(f"policy {self.name}: {agent.failure}")

    def described(self) -> tuple[str, tuple[ParameterText, ...]]:
        """Return the first line of the policy's docstring, and its parameters.

        Raise InputError as :meth:`check`.
        """
        with self.agent() as agent:
            try:
                return agent.described()
            except PolicyError as error:
                raise InputError(f"policy {self.name}: {error}") from error

    @contextmanager
    def agent(self) -> Iterator[RemoteAgent]:
        """Yield a new agent for one episode; its processes end with it.

        If the policy cannot be made, ``reset`` raises the reason.
        """
        seen, policy = self._assignment()
        sandbox = _kept(self.isolation, seen, self.limits)
        load = Load(policy, f"{self.source_digest} {self.instance}")
        with contextlib.closing(remote_agent(sandbox, load, self.limits)) as agent:
            yield agent

    def _assignment(self) -> tuple[Path | None, Assignment]:
        """Return the file or folder that the policy sees, and the policy to serve."""
        file, colon, name = self.origin.rpartition(":")
        seen, origin = self.folder.resolve() if self.folder else None, self.origin
        if seen is None and colon and file.endswith(".py"):
            seen = Path(file).resolve()
            origin = f"{seen}:{name}"
        if seen is not None and (seen == AGENTS.parent or seen in AGENTS.parents):
            raise InputError(f"{seen} holds colift itself: put the policy into a folder of its own")
        return seen, Assignment(origin, self.parameters, self.size)


def _kept(isolation: str, seen: Path | None, limits: Limits) -> Sandbox:
    """Return this thread's sandbox, started if there is none."""
    if getattr(_local, "process", None) != os.getpid():
        _local.process, _local.sandboxes = os.getpid(), OrderedDict()
        if threading.current_thread() is threading.main_thread():
            atexit.register(_close_own, os.getpid())
    kept: OrderedDict[object, Sandbox] = _local.sandboxes
    key = isolation, seen, limits
    if key not in kept:
        kept[key] = Sandbox(*key)
    kept.move_to_end(key)
    while len(kept) > KEPT:
        kept.popitem(last=False)[1].close()
    return kept[key]


def _close_own(process: int) -> None:
    """End the sandboxes of this thread, unless they are those of the process that forked it."""
    if process == os.getpid():
        close_sandboxes()


def kept_sandboxes() -> tuple[Sandbox, ...]:
    """Return the sandboxes that this thread keeps."""
    return tuple(getattr(_local, "sandboxes", {}).values())


def close_sandboxes() -> None:
    """End the sandboxes that this thread keeps."""
    kept = getattr(_local, "sandboxes", {})
    while kept:
        kept.popitem()[1].close()
