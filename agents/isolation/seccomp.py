"""A filter of system calls: what no policy needs, and what would outlive or leave its sandbox."""

import ctypes
import os
import struct
from typing import Final

from .linux import prctl

_PR_SET_SECCOMP: Final = 22
_MODE_FILTER: Final = 2

_ARCHITECTURE: Final = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}

_CALLS: Final = {
    # Other processes, and the kernel's wide doors.
    "ptrace": (101, 117),
    "process_vm_readv": (310, 270),
    "process_vm_writev": (311, 271),
    "kcmp": (312, 272),
    "pidfd_getfd": (438, 438),
    "perf_event_open": (298, 241),
    "bpf": (321, 280),
    "userfaultfd": (323, 282),
    "io_uring_setup": (425, 425),
    "open_by_handle_at": (304, 265),
    # Keys and objects that are no files: they could carry state, or memory that is not counted.
    "keyctl": (250, 219),
    "add_key": (248, 217),
    "request_key": (249, 218),
    "memfd_create": (319, 279),
    "memfd_secret": (447, 447),
    "shmget": (29, 194),
    "semget": (64, 190),
    "msgget": (68, 186),
    "mq_open": (240, 180),
    # Namespaces and mounts.
    "unshare": (272, 97),
    "setns": (308, 268),
    "mount": (165, 40),
    "umount2": (166, 39),
    "pivot_root": (155, 41),
    "chroot": (161, 51),
    "open_tree": (428, 428),
    "move_mount": (429, 429),
    "fsopen": (430, 430),
    "fsconfig": (431, 431),
    "fsmount": (432, 432),
    "fspick": (433, 433),
    "mount_setattr": (442, 442),
}
"""Refused system calls, with their numbers on x86_64 and on aarch64."""

_CLONE: Final = (56, 220)
_CLONE3: Final = (435, 435)
_SOCKET: Final = (41, 198)
_NAMESPACES: Final = 0x7E020000
"""All CLONE_NEW flags."""
_AF_UNIX: Final = 1
_X32: Final = 0x40000000

_LOAD, _EQUAL, _GREATER_EQUAL, _ANY_BIT, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_ALLOW: Final = 0x7FFF0000
_REFUSE: Final = 0x00050000 | 1  # EPERM
_ABSENT: Final = 0x00050000 | 38  # ENOSYS: the C library falls back to clone
_KILL: Final = 0x80000000
_NUMBER, _ARCH, _FIRST_ARGUMENT = 0, 4, 16


def install() -> bool:
    """Filter this process and all it will start, for good; return whether it can be done here.

    It must have forbidden new privileges before.
    """
    machine = os.uname().machine
    if machine not in _ARCHITECTURE:
        return False
    program = _program(machine)
    buffer = ctypes.create_string_buffer(program)
    head = ctypes.create_string_buffer(
        struct.pack("HP", len(program) // 8, ctypes.addressof(buffer))
    )
    try:
        prctl(_PR_SET_SECCOMP, _MODE_FILTER, ctypes.addressof(head))
    except OSError:
        return False
    return True


def _program(machine: str) -> bytes:
    """Return the filter for the Berkeley packet filter machine of the kernel."""
    column = list(_ARCHITECTURE).index(machine)
    code = [
        _instruction(_LOAD, _ARCH),
        _instruction(_EQUAL, _ARCHITECTURE[machine], yes=1),
        _instruction(_RETURN, _KILL),
        _instruction(_LOAD, _NUMBER),
        _instruction(_GREATER_EQUAL, _X32, no=1),
        _instruction(_RETURN, _REFUSE),
    ]
    for numbers in _CALLS.values():
        code += _when(numbers[column], [_instruction(_RETURN, _REFUSE)])
    code += _when(_CLONE3[column], [_instruction(_RETURN, _ABSENT)])
    code += _when(
        _CLONE[column],
        [
            _instruction(_LOAD, _FIRST_ARGUMENT),
            _instruction(_ANY_BIT, _NAMESPACES, no=1),
            _instruction(_RETURN, _REFUSE),
            _instruction(_RETURN, _ALLOW),
        ],
    )
    code += _when(
        _SOCKET[column],
        [
            _instruction(_LOAD, _FIRST_ARGUMENT),
            _instruction(_EQUAL, _AF_UNIX, yes=1),
            _instruction(_RETURN, _REFUSE),
            _instruction(_RETURN, _ALLOW),
        ],
    )
    return b"".join([*code, _instruction(_RETURN, _ALLOW)])


def _when(number: int, then: list[bytes]) -> list[bytes]:
    """Return code that does something for one system call, and nothing for others."""
    return [_instruction(_EQUAL, number, no=len(then)), *then]


def _instruction(code: int, value: int, *, yes: int = 0, no: int = 0) -> bytes:
    return struct.pack("HBBI", code, yes, no, value)
