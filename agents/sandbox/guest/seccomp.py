"""A filter of system calls, which allows those that Python, NumPy, SciPy and scikit-learn need.

All others are refused: among them calls that leave a trace for a later lift or reveal an earlier
one (attributes, times and locks of shared files, the page cache, counters of the kernel), that take
memory that is charged to no process (sockets, memory files, System V), that start programs, make
namespaces or change the processor, and all calls of the x32 interface, whose numbers differ.
"""

import ctypes
import os
import struct
from collections.abc import Iterator
from typing import Final

from .linux import prctl

_PR_SET_SECCOMP: Final = 22
_MODE_FILTER: Final = 2

_ARCHITECTURE: Final = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}

_CALLS: Final = """
read 0 63, write 1 64, readv 19 65, writev 20 66, pread64 17 67, pwrite64 18 68, lseek 8 62,
close 3 57, close_range 436 436, dup 32 23, dup2 33 -, dup3 292 24, pipe 22 -, pipe2 293 59,
open 2 -, openat 257 56, creat 85 -, stat 4 -, fstat 5 80, lstat 6 -, newfstatat 262 79,
access 21 -, faccessat 269 48, faccessat2 439 439, readlink 89 -, readlinkat 267 78,
getdents64 217 61, getcwd 79 17, chdir 80 49, fchdir 81 50, umask 95 166,
mkdir 83 -, mkdirat 258 34, rmdir 84 -, unlink 87 -, unlinkat 263 35, rename 82 -,
renameat 264 38, renameat2 316 276, symlink 88 -, symlinkat 266 36, truncate 76 45,
ftruncate 77 46, poll 7 -, ppoll 271 73, select 23 -, pselect6 270 72,
sendto 44 206, recvfrom 45 207, sendmsg 46 211, recvmsg 47 212, shutdown 48 210, getsockname 51 204,
munmap 11 215, mprotect 10 226, mremap 25 216, brk 12 214, msync 26 227, membarrier 324 283,
fork 57 -, vfork 58 -, wait4 61 260, waitid 247 95, exit 60 93, exit_group 231 94, futex 202 98,
set_robust_list 273 99, rseq 334 293, set_tid_address 218 96, gettid 186 178, getpid 39 172,
getppid 110 173, getpgrp 111 -, getpgid 121 155, setpgid 109 154, getsid 124 156, setsid 112 157,
getuid 102 174, geteuid 107 175, getgid 104 176, getegid 108 177, getresuid 118 148,
getresgid 120 150, getgroups 115 158, getrlimit 97 163, setrlimit 160 164, getrusage 98 165,
times 100 153, sched_yield 24 124, sched_getaffinity 204 123, getcpu 309 168, nanosleep 35 101,
clock_nanosleep 230 115, clock_gettime 228 113, clock_getres 229 114, gettimeofday 96 169,
time 201 -, alarm 37 -, setitimer 38 103, getitimer 36 102, pause 34 -, rt_sigaction 13 134,
rt_sigprocmask 14 135, rt_sigreturn 15 139, rt_sigpending 127 136, rt_sigsuspend 130 133,
rt_sigtimedwait 128 137, sigaltstack 131 132, restart_syscall 219 128, kill 62 129, tkill 200 130,
tgkill 234 131, uname 63 160, getrandom 318 278, arch_prctl 158 -
"""
"""Allowed calls with their numbers on x86_64 and aarch64, from the kernel's tables of calls."""

_ABSENT_CALLS: Final = {"clone3": (435, 435), "statx": (332, 291)}
"""Calls that are reported as missing: the C library then uses an older one."""

_EPERM, _EINVAL, _ENOSYS = 1, 22, 38
_NUMBER, _ARCH, _ARGUMENTS = 0, 4, 16
_LOAD, _EQUAL, _ANY_BIT, _AND, _RETURN = 0x20, 0x15, 0x45, 0x54, 0x06
_ALLOW: Final = 0x7FFF0000
_ERROR: Final = 0x00050000
_KILL: Final = 0x80000000

_ONE_OF: Final = {
    # F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_DUPFD_CLOEXEC: no locks, leases, pipe sizes.
    "fcntl": ((72, 25), 1, _EPERM, (0, 1, 2, 3, 4, 1030)),
    # TCGETS, TIOCGWINSZ, FIONREAD, FIONBIO, FIONCLEX, FIOCLEX.
    "ioctl": ((16, 29), 1, _EPERM, (0x5401, 0x5413, 0x541B, 0x5421, 0x5450, 0x5451)),
    # NORMAL, DONTNEED, FREE, DONTFORK, DOFORK, HUGEPAGE, NOHUGEPAGE.
    "madvise": ((28, 233), 2, _EINVAL, (0, 4, 8, 10, 11, 14, 15)),
    # PR_SET_NAME, PR_GET_NAME.
    "prctl": ((157, 167), 0, _EPERM, (15, 16)),
    # Of the calling process only.
    "prlimit64": ((302, 261), 0, _EPERM, (0,)),
}
"""Calls with an argument that must have an allowed value: numbers, argument, error, values."""


def instruction(code: int, value: int, *, yes: int = 0, no: int = 0) -> bytes:
    """Return an instruction; a test skips ``yes`` instructions if it holds, else ``no``."""
    return struct.pack("HBBI", code, yes, no, value)


_ALLOWED: Final = instruction(_RETURN, _ALLOW)

_UNLESS: Final = {
    # All CLONE_NEW, CLONE_PARENT, CLONE_PIDFD.
    "clone": ((56, 220), 0, [instruction(_ANY_BIT, 0x7E029000, no=1)]),
    # Shared and anonymous: memory that outlives its processes.
    "mmap": ((9, 222), 3, [instruction(_AND, 0x21), instruction(_EQUAL, 0x21, no=1)]),
}
"""Calls that are refused if an argument passes a test of its bits: numbers, argument, test."""


def install() -> bool:
    """Filter this process and its descendants, irrevocably; return whether that works here.

    The process must have renounced new privileges before (``PR_SET_NO_NEW_PRIVS``).
    """
    machine = os.uname().machine
    if machine not in _ARCHITECTURE:
        return False
    program = b"".join(_program(machine))
    buffer = ctypes.create_string_buffer(program)
    head = ctypes.create_string_buffer(
        struct.pack("HP", len(program) // 8, ctypes.addressof(buffer))
    )
    try:
        prctl(_PR_SET_SECCOMP, _MODE_FILTER, ctypes.addressof(head))
    except OSError:
        return False
    return True


def _program(machine: str) -> Iterator[bytes]:
    column = list(_ARCHITECTURE).index(machine)
    yield instruction(_LOAD, _ARCH)
    yield instruction(_EQUAL, _ARCHITECTURE[machine], yes=1)
    yield instruction(_RETURN, _KILL)
    yield instruction(_LOAD, _NUMBER)
    for words in map(str.split, _CALLS.split(",")):
        if words[1 + column] != "-":
            yield from _when(int(words[1 + column]), _ALLOWED)
    for numbers in _ABSENT_CALLS.values():
        yield from _when(numbers[column], _refuse(_ENOSYS))
    for numbers, argument, error, values in _ONE_OF.values():
        tests = [
            instruction(_EQUAL, value, yes=len(values) - place)
            for place, value in enumerate(values)
        ]
        yield from _when(numbers[column], _argument(argument), *tests, _refuse(error), _ALLOWED)
    for numbers, argument, tests in _UNLESS.values():
        yield from _when(numbers[column], _argument(argument), *tests, _refuse(_EPERM), _ALLOWED)
    yield _refuse(_EPERM)


def _when(number: int, *then: bytes) -> Iterator[bytes]:
    """Yield code that does something for one system call, and nothing for others."""
    yield instruction(_EQUAL, number, no=len(then))
    yield from then


def _argument(number: int) -> bytes:
    """Return code that loads the lower half of an argument: the kernel checks only that."""
    return instruction(_LOAD, _ARGUMENTS + 8 * number)


def _refuse(error: int) -> bytes:
    return instruction(_RETURN, _ERROR | error)
