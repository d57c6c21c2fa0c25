"""The few system calls of Linux that Python does not have."""

import ctypes
import os
import struct
from typing import Final

CLONE_NEWNS: Final = 0x00020000
CLONE_NEWUTS: Final = 0x04000000
CLONE_NEWIPC: Final = 0x08000000
CLONE_NEWUSER: Final = 0x10000000
CLONE_NEWPID: Final = 0x20000000
CLONE_NEWNET: Final = 0x40000000

MS_RDONLY: Final = 1
MS_NOSUID: Final = 2
MS_NODEV: Final = 4
MS_NOEXEC: Final = 8
MS_REMOUNT: Final = 32
MS_BIND: Final = 4096
MS_REC: Final = 16384
MS_PRIVATE: Final = 1 << 18

CAP_DAC_READ_SEARCH: Final = 2

_PR_SET_DUMPABLE: Final = 4
_PR_SET_KEEPCAPS: Final = 8
_PR_CAPBSET_DROP: Final = 24
_PR_SET_CHILD_SUBREAPER: Final = 36
_PR_SET_NO_NEW_PRIVS: Final = 38
_PR_CAP_AMBIENT: Final = 47
_PR_CAP_AMBIENT_CLEAR_ALL: Final = 4
_CAPSET: Final = {"x86_64": 126, "aarch64": 91}
_CAPABILITY_VERSION_3: Final = 0x20080522

libc = ctypes.CDLL(None, use_errno=True)
libc.syscall.restype = ctypes.c_long


def checked(result: int, what: str) -> int:
    """Return the result of a call.

    Raises
    ------
    OSError
        If it is negative: the call failed.
    """
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")
    return result


def syscall(number: int, *arguments: object, what: str) -> int:
    """Make a system call by its number."""
    wide = [ctypes.c_long(each) if isinstance(each, int) else each for each in arguments]
    return checked(libc.syscall(ctypes.c_long(number), *wide), what)


def prctl(option: int, *arguments: int) -> int:
    """Change something of this process."""
    wide = [ctypes.c_ulong(each) for each in (*arguments, 0, 0, 0, 0)[:4]]
    return checked(libc.prctl(option, *wide), f"prctl {option}")


def unshare(flags: int) -> None:
    """Leave the namespaces of the parent."""
    checked(libc.unshare(flags), f"unshare {flags:#x}")


def join(path: str, kind: int) -> None:
    """Enter a namespace, given as a file; one of processes only for the children."""
    handle = os.open(path, os.O_RDONLY)
    try:
        checked(libc.setns(handle, kind), f"setns {path}")
    finally:
        os.close(handle)


def mount(source: str, target: str, kind: str, flags: int = 0, options: str = "") -> None:
    """Mount a file system."""
    words = [each.encode() for each in (source, target, kind)]
    wide = ctypes.c_ulong(flags)
    checked(libc.mount(*words, wide, options.encode() or None), f"mount {kind or source} {target}")


def become_subreaper() -> None:
    """Inherit the descendants whose parents end."""
    prctl(_PR_SET_CHILD_SUBREAPER, 1)


def hide(hidden: bool) -> None:
    """Say whether other processes of the same user may not trace this one, or look into it."""
    prctl(_PR_SET_DUMPABLE, 0 if hidden else 1)


def forbid_new_privileges() -> None:
    """Gain nothing from set-uid programs, for good."""
    prctl(_PR_SET_NO_NEW_PRIVS, 1)


def become(user: int, group: int) -> None:
    """Become another user and keep the capabilities, to be dropped afterwards."""
    prctl(_PR_SET_KEEPCAPS, 1)
    os.setgroups([])
    os.setresgid(group, group, group)
    os.setresuid(user, user, user)
    prctl(_PR_SET_KEEPCAPS, 0)


def drop_capabilities(keep: int = 0) -> None:
    """Drop all capabilities for good, but those of the bit mask ``keep``."""
    for capability in range(64):
        libc.prctl(_PR_CAPBSET_DROP, ctypes.c_ulong(capability), 0, 0, 0)
    libc.prctl(_PR_CAP_AMBIENT, ctypes.c_ulong(_PR_CAP_AMBIENT_CLEAR_ALL), 0, 0, 0)
    header = struct.pack("Ii", _CAPABILITY_VERSION_3, 0)
    data = struct.pack("IIIIII", keep, keep, 0, 0, 0, 0)
    syscall(_CAPSET[os.uname().machine], header, data, what="capset")
