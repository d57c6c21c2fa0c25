"""The ladder: the ways to isolate a policy, strongest first, and which of them work here."""

import functools
import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

from ..errors import EvaluatorFault, InputError, PolicyError
from .launch import BUBBLEWRAP, LANDLOCK, LIMITS
from .limits import LIMITS as BUDGETS
from .sandbox import Sandbox
from .view import AGENTS

DESCRIPTIONS: Final = {
    BUBBLEWRAP: "bubblewrap: own file system, processes, network and users; Landlock, filter",
    LANDLOCK: "Landlock, filter of system calls, and namespaces where they can be had",
    LIMITS: "resource limits only: the policy can read files, use the network, end processes",
}

VERIFIABLE: Final = frozenset({BUBBLEWRAP, LANDLOCK})
"""Rungs whose results can be called verified: on the others a policy can cheat."""

_SECONDS: Final = 10.0


def rungs() -> tuple[str, ...]:
    """Return the rungs that work here, strongest first."""
    return tuple(name for name in DESCRIPTIONS if fault(name) is None)


def strongest() -> str:
    """Return the strongest rung that works here.

    Raises
    ------
    EvaluatorFault
        If none does.
    """
    for name in DESCRIPTIONS:
        if fault(name) is None:
            return name
    reasons = "; ".join(f"{name}: {fault(name)}" for name in DESCRIPTIONS)
    raise EvaluatorFault(f"no sandbox works here: {reasons}")


def describe(name: str) -> str:
    """Return a line about a rung.

    Raises
    ------
    InputError
        If there is no such rung.
    """
    if name not in DESCRIPTIONS:
        raise InputError(f"unknown isolation {name!r}; known: {', '.join(DESCRIPTIONS)}")
    return DESCRIPTIONS[name]


@functools.cache
def fault(name: str) -> str | None:
    """Return why a rung does not work here, None if it does: found out by trying, once.

    Raises
    ------
    InputError
        If there is no such rung.
    """
    describe(name)
    try:
        found = holes(name)
    except (EvaluatorFault, PolicyError) as error:
        return str(error)
    return "; ".join(found) if found and name in VERIFIABLE else None


def holes(name: str) -> list[str]:
    """Return what a policy can do on a rung that it should not: a probe tries.

    Raises
    ------
    EvaluatorFault, PolicyError
        If the rung does not work here.
    """
    with (
        tempfile.TemporaryDirectory(prefix="colift-probe-") as directory,
        socket.create_server(("127.0.0.1", 0)) as listening,
        subprocess.Popen(
            [sys.executable, "-S", "-c", "import sys; sys.stdin.read()"], stdin=subprocess.PIPE
        ) as other,
    ):
        secret = Path(directory, "secret")
        secret.write_text("secret")
        sandbox = Sandbox(name, None, BUDGETS)
        try:
            connection = sandbox.probe(
                {
                    "files": [
                        str(secret),
                        "/etc/shadow",
                        str(AGENTS / "humans" / "__init__.py"),
                        str(AGENTS.parent / "benchmark" / "__init__.py"),
                    ],
                    "directory": directory,
                    "port": listening.getsockname()[1],
                    "process": other.pid,
                    "processes": os.readlink("/proc/self/ns/pid"),  # noqa: PTH115
                }
            )
            try:
                kind, found = connection.request(["look"], _SECONDS)
            finally:
                connection.close()
        finally:
            sandbox.close()
            other.kill()
    return [str(each) for each in found] if kind == "found" else [f"the probe says {kind}"]
