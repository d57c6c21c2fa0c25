"""The fork server: a small trusted process in the sandbox, which starts those of policies.

It has imported NumPy and the server of policies, but no untrusted code.
"""

import contextlib
import gc
import json
import os
import signal
import socket
import sys
import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Final

from colift.agents.sandbox.guest import landlock, linux
from colift.agents.sandbox.guest.pages import Pages, mappings
from colift.agents.sandbox.guest.restrictions import Restrictions
from colift.agents.sandbox.guest.server import serve
from colift.agents.sandbox.guest.spawn import Ends, spawn
from colift.agents.sandbox.protocol import ORDER, Assignment, Limits

_TRIAL_SECONDS: Final = 30.0
"""Time limit for the trial of a process, for a busy machine [s]."""


def main(handle: int) -> None:
    """Serve orders on a socket until its other side closes."""
    orders = socket.socket(fileno=handle)
    settings = json.loads(orders.recv(ORDER))
    linux.hide(True)
    linux.prctl(linux.PR_SET_CHILD_SUBREAPER, 1)
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.freeze()
    os.umask(0o022)
    pages = Pages()
    for mapping in mappings(Path("/proc/self/maps").read_bytes()):
        pages.keep(mapping)
    try:
        restrictions = _restrictions(settings)
    except OSError as error:
        sys.exit(str(error))
    orders.send(json.dumps(restrictions.namespaces).encode())
    with contextlib.ExitStack() as stack:
        if not restrictions.namespaces:
            # The fork server makes and removes it, since it outlives its owner, which may be
            # killed.
            scratch = tempfile.TemporaryDirectory(prefix="colift-", ignore_cleanup_errors=True)
            kept = stack.enter_context(scratch)
        while True:
            order, handles, _, _ = socket.recv_fds(orders, ORDER, 3)
            if not order:
                return
            policy = Assignment(*json.loads(order))
            if not restrictions.namespaces:
                restrictions = replace(restrictions, scratch=Path(tempfile.mkdtemp(dir=kept)))
            spawn(restrictions, Ends(*handles), partial(serve, policy=policy), pages)


def _restrictions(settings: dict[str, Any]) -> Restrictions:
    """Return the restrictions of a level; raise OSError if they do not work here."""
    kernel = landlock.version() > 0
    if settings["landlock"] and not kernel:
        raise OSError("the kernel has no Landlock")
    restrictions = Restrictions(
        landlock=kernel,
        readable=tuple(map(Path, settings["readable"])),
        hidden=tuple(map(Path, settings["hidden"])),
        folder=Path(settings["folder"]) if settings["folder"] else None,
        limits=Limits(**settings["limits"]),
        doors=tuple(settings["doors"]),
    )
    if not settings["namespaces"]:
        return restrictions
    reasons = []
    for kind in ("root", "user") if os.geteuid() == 0 else ("user",):
        separate = replace(restrictions, namespaces=kind)
        reason = _fault(separate)
        if not reason:
            return separate
        reasons.append(f"no namespaces by {kind}: {reason}")
    raise OSError("; ".join(reasons))


def _fault(restrictions: Restrictions) -> str:
    """Return the reason why a process with these restrictions fails; empty if it does not."""
    here, status = socket.socketpair()
    data, output = (os.open("/dev/null", os.O_WRONLY) for _ in range(2))
    with here:
        here.settimeout(_TRIAL_SECONDS)
        try:
            spawn(restrictions, Ends(data, output, status.detach()), lambda filtered: None, Pages())
            report = here.recv(1000).decode().strip()
        except OSError as error:
            return str(error)
    return "" if report == "exit 0" else report or "it was ended"
