"""Refusals of namespaces by a machine, in one sentence each, with the cure."""

import re
from typing import Final

_NAMESPACES: Final = re.compile(r"namespace|unshare|setns|uid map|gid map|bwrap: loopback")

_REFUSALS: Final = (
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
        "a container: docker run --security-opt seccomp=unconfined",
    ),
)
"""Errors of the kernel: a limit of namespaces, a security module, a setting or a filter."""

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
