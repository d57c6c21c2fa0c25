"""Refusals of namespaces by a machine, in one sentence each, with the cure."""

import re
from typing import Final

_NAMESPACES: Final = re.compile(
    r"namespace|unshare|setns|uid map|gid map|bwrap: loopback|mount proc"
)

CONTAINER: Final = (
    "docker run --security-opt seccomp=unconfined --security-opt systempaths=unconfined"
)
"""How Docker runs a container in which a sandbox can be made: with all calls, and the whole of
``/proc``, without which the kernel refuses the sandbox a ``/proc`` of its own."""

_REFUSALS: Final = (
    (
        re.compile(r"mount proc"),
        f"this container hides parts of /proc: {CONTAINER}",
    ),
    (
        re.compile(r"\[Errno 28\]|No space left on device"),
        "this machine allows no more user namespaces: sysctl -w user.max_user_namespaces=15000",
    ),
    (
        re.compile(r"\[Errno 13\]|Permission denied"),
        "this machine's AppArmor forbids user namespaces: "
        "sysctl -w kernel.apparmor_restrict_unprivileged_userns=0",
    ),
    (
        re.compile(r"\[Errno 1\]|Operation not permitted|No permissions to create"),
        "this machine forbids user namespaces: sysctl -w kernel.unprivileged_userns_clone=1, or in "
        f"a container: {CONTAINER}",
    ),
)
"""Errors of the kernel: a hidden ``/proc``, a limit of namespaces, a security module, a setting, a
filter."""

GUIDE: Final = "see docs/guides/sandbox.md"


def in_words(reason: str) -> str:
    """Return the sentence for a known refusal of namespaces; another reason as it is.

    Parameters
    ----------
    reason
        What bubblewrap or the fork server has printed, in the system's words.
    """
    if _NAMESPACES.search(reason):
        for pattern, sentence in _REFUSALS:
            if pattern.search(reason):
                return f"{sentence} ({GUIDE})"
    return reason
