"""The few system calls of Linux that Python does not have."""

import ctypes
import os
import struct
import sys
from typing import Final

CLONE_NEWUSER: Final = 0x10000000
CLONE_NEWPID: Final = 0x20000000
CLONE_OTHERS: Final = 0x00020000 | 0x02000000 | 0x04000000 | 0x08000000 | 0x40000000
"""The other namespaces: of mounts, control groups, host names, IPC and the network."""

MS_RDONLY: Final = 1
MS_NOSUID: Final = 2
MS_NODEV: Final = 4
MS_NOEXEC: Final = 8
MS_BIND: Final = 4096
MS_REC: Final = 16384
MS_PRIVATE: Final = 1 << 18

CAP_DAC_READ_SEARCH: Final = 2

_PR_SET_DUMPABLE: Final = 4
_PR_SET_KEEPCAPS: Final = 8
_PR_CAPBSET_DROP: Final = 24
PR_SET_CHILD_SUBREAPER: Final = 36
PR_SET_NO_NEW_PRIVS: Final = 38
_PR_CAP_AMBIENT: Final = 47
_PR_CAP_AMBIENT_CLEAR_ALL: Final = 4
_MOUNT_SETATTR: Final = 442
_AT_FDCWD: Final = -100
_AT_RECURSIVE: Final = 0x8000
_RDONLY_NOSUID: Final = 3
_MNT_DETACH: Final = 2
_PROT_READ, _MAP_SHARED, _MAP_LOCKED, _MAP_POPULATE = 1, 1, 0x2000, 0x8000
_MAP_FAILED: Final = ctypes.c_void_p(-1).value
_CAPSET: Final = {"x86_64": 126, "aarch64": 91}
_CAPABILITY_VERSION_3: Final = 0x20080522

if sys.platform == "linux":  # Its code is read elsewhere too, for digests, but never run.
    libc = ctypes.CDLL(None, use_errno=True)
    libc.syscall.restype = ctypes.c_long
    libc.mmap.restype = ctypes.c_void_p
    libc.mmap.argtypes = [
        *(ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int),
        *(ctypes.c_int, ctypes.c_int, ctypes.c_long),
    ]


def checked(result: int, what: str) -> int:
    """Return the result of a call; raise OSError if it is negative: the call failed."""
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")
    return result


def syscall(number: int, *arguments: int | bytes | ctypes.Array[ctypes.c_char], what: str) -> int:
    """Make a system call by its number; ``what`` names it in an error."""
    wide = [ctypes.c_long(each) if isinstance(each, int) else each for each in arguments]
    return checked(libc.syscall(ctypes.c_long(number), *wide), what)


def prctl(option: int, *arguments: int) -> int:
    """Change an attribute of this process."""
    wide = [ctypes.c_ulong(each) for each in (*arguments, 0, 0, 0, 0)[:4]]
    return checked(libc.prctl(option, *wide), f"prctl {option}")


def unshare(flags: int) -> None:
    """Leave the namespaces of the parent."""
    checked(libc.unshare(flags), f"unshare {flags:#x}")


def join(path: str, kind: int) -> None:
    """Enter a namespace, given as a file; a process namespace is entered by children only."""
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


def make_read_only(place: str, read_only: bool) -> None:
    """Make all that is mounted at and beneath a place read-only, or the place alone writable."""
    change = struct.pack("QQQQ", _RDONLY_NOSUID * read_only, not read_only, 0, 0)
    flags = _AT_RECURSIVE * read_only
    words = place.encode()
    syscall(_MOUNT_SETATTR, _AT_FDCWD, words, flags, change, len(change), what=f"set {place}")


def change_root(place: str) -> None:
    """Make the mount at a place the root directory, and detach the old one."""
    os.chdir(place)
    checked(libc.pivot_root(b".", b"."), f"pivot_root {place}")
    checked(libc.umount2(b".", _MNT_DETACH), "umount /")
    os.chdir("/")


def keep_in_memory(file: int, place: int, size: int) -> None:
    """Bring a part of a file into memory, and keep it there for as long as this process lives.

    It is locked if that is allowed.
    """
    flags = _MAP_SHARED | _MAP_POPULATE
    for more in (_MAP_LOCKED, 0):
        found = libc.mmap(None, size, _PROT_READ, flags | more, file, place)
        if found != _MAP_FAILED:
            return
    raise OSError(ctypes.get_errno(), "mmap")


def hide(hidden: bool) -> None:
    """Set whether processes of the same user are prevented from tracing or reading this one."""
    prctl(_PR_SET_DUMPABLE, 0 if hidden else 1)


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
