"""Three filters of system calls: while a policy loads, where lifts are forked from, in a lift.

A call that no rule allows is refused. A policy that loads has what Python, NumPy, SciPy and
scikit-learn need to be imported. In a lift only its connection, its output, its own memory, clocks
and its end are left: no call by which another process could tell what the lift has seen.
"""

import ctypes
import platform
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, NamedTuple

from colift.agents.sandbox.guest.linux import syscall

CHANNEL: Final = 3
"""File descriptor of the connection; 1 and 2 are the output."""

_ARCHITECTURES: Final = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
_MACHINE: Final = platform.machine()

_TABLE: Final = """
read 0 63, write 1 64, readv 19 65, writev 20 66, pread64 17 67, pwrite64 18 68, lseek 8 62, close 3
57, close_range 436 436, dup 32 23, dup2 33 -, dup3 292 24, open 2 -, openat 257 56, creat 85 -,
stat 4 -, fstat 5 80, lstat 6 -, newfstatat 262 79, access 21 -, faccessat 269 48, faccessat2 439
439, readlink 89 -, readlinkat 267 78, getdents64 217 61, getcwd 79 17, chdir 80 49, fchdir 81 50,
umask 95 166, mkdir 83 -, mkdirat 258 34, rmdir 84 -, unlink 87 -, unlinkat 263 35, rename 82 -,
renameat 264 38, renameat2 316 276, symlink 88 -, symlinkat 266 36, truncate 76 45, ftruncate 77 46,
poll 7 -, ppoll 271 73, select 23 -, pselect6 270 72, sendto 44 206, recvfrom 45 207, sendmsg 46
211, recvmsg 47 212, getsockname 51 204, munmap 11 215, mremap 25 216, brk 12 214, mmap 9 222,
mprotect 10 226, madvise 28 233, membarrier 324 283, clone 56 220, clone3 435 435, wait4 61 260,
exit 60 93, exit_group 231 94, futex 202 98, set_robust_list 273 99, rseq 334 293, set_tid_address
218 96, gettid 186 178, getpid 39 172, getppid 110 173, getpgrp 111 -, getpgid 121 155, getsid 124
156, getuid 102 174, geteuid 107 175, getgid 104 176, getegid 108 177, getresuid 118 148, getresgid
120 150, getgroups 115 158, getrlimit 97 163, setrlimit 160 164, prlimit64 302 261, getrusage 98
165, times 100 153, sched_yield 24 124, sched_getaffinity 204 123, getcpu 309 168, nanosleep 35 101,
clock_nanosleep 230 115, clock_gettime 228 113, clock_getres 229 114, gettimeofday 96 169, time 201
-, alarm 37 -, setitimer 38 103, getitimer 36 102, pause 34 -, rt_sigaction 13 134, rt_sigprocmask
14 135, rt_sigreturn 15 139, rt_sigpending 127 136, rt_sigsuspend 130 133, rt_sigtimedwait 128 137,
sigaltstack 131 132, restart_syscall 219 128, kill 62 129, tkill 200 130, tgkill 234 131, uname 63
160, statx 332 291, getrandom 318 278, arch_prctl 158 -, fcntl 72 25, ioctl 16 29, prctl 157 167,
seccomp 317 277
"""
"""The calls' numbers on x86_64 and aarch64, from the kernel's tables of calls."""


def _numbers() -> dict[str, int]:
    column = 1 + list(_ARCHITECTURES).index(_MACHINE) if _MACHINE in _ARCHITECTURES else 1
    rows = [row.split() for row in _TABLE.split(",")]
    return {row[0]: int(row[column]) for row in rows if row[column] != "-"}


NUMBERS: Final = _numbers()
"""The numbers of the calls that this machine has."""

_EPERM, _EINVAL, _ENOSYS = 1, 22, 38
_ALLOW: Final = 0x7FFF0000
_ASK: Final = 0x7FC00000
"""The process that watches decides."""
_KILL: Final = 0x80000000
_WHOLE: Final = 0xFFFFFFFF


def _refuse(error: int) -> int:
    return 0x00050000 | error


class Condition(NamedTuple):
    """A test of the lower half of an argument, which is all that the kernel uses of these."""

    argument: int
    mask: int
    values: tuple[int, ...]
    """The allowed values of the masked argument."""
    otherwise: int = _refuse(_EPERM)
    """What happens if it has another value."""


@dataclass(frozen=True, kw_only=True)
class Filter:
    """The allowed calls, and the conditions on the arguments of some."""

    allowed: str
    conditions: dict[str, tuple[Condition, ...]]
    verdicts: dict[str, int]
    """Calls with another answer."""

    def program(self) -> bytes:
        """Return the filter as a program of the kernel's (classic BPF)."""
        return b"".join(self._instructions())

    def _instructions(self) -> Iterator[bytes]:
        yield _load(_ARCH)
        yield instruction(_EQUAL, _ARCHITECTURES[_MACHINE], yes=1)
        yield instruction(_RETURN, _KILL)
        yield _load(_NUMBER)
        for name in (*self.allowed.split(), *self.verdicts):
            if name in NUMBERS:
                tests = b"".join(map(_test, self.conditions.get(name, ())))
                then = tests + instruction(_RETURN, self.verdicts.get(name, _ALLOW))
                yield instruction(_EQUAL, NUMBERS[name], no=len(then) // 8) + then
        yield instruction(_RETURN, _refuse(_EPERM))


_NUMBER, _ARCH, _ARGUMENTS = 0, 4, 16
_LOAD, _EQUAL, _AND, _RETURN = 0x20, 0x15, 0x54, 0x06


def instruction(code: int, value: int, *, yes: int = 0, no: int = 0) -> bytes:
    """Return an instruction; a test skips ``yes`` instructions if it holds, else ``no``."""
    return struct.pack("HBBI", code, yes, no, value)


def _load(place: int) -> bytes:
    return instruction(_LOAD, place)


def _test(condition: Condition) -> bytes:
    """Return the code that ends with ``otherwise`` unless a condition holds."""
    argument, mask, values, otherwise = condition
    tests = [
        instruction(_EQUAL, value, yes=len(values) - place) for place, value in enumerate(values)
    ]
    return b"".join(
        [
            _load(_ARGUMENTS + 8 * argument),
            instruction(_AND, mask),
            *tests,
            instruction(_RETURN, otherwise),
        ]
    )


_UNSHARED: Final = Condition(3, 0x1, (0,))
"""No shared mapping: what one process writes into its memory, no other reads."""

_ADVICE: Final = Condition(2, _WHOLE, (0, 4, 8, 10, 11, 14, 15), _refuse(_EINVAL))
"""NORMAL, DONTNEED, FREE, DONTFORK, DOFORK, HUGEPAGE, NOHUGEPAGE."""

LOADING: Final = Filter(
    allowed="""
    read write readv writev pread64 pwrite64 lseek close close_range dup dup2 dup3 open openat creat
    stat fstat lstat newfstatat access faccessat faccessat2 readlink readlinkat getdents64 getcwd
    chdir fchdir umask mkdir mkdirat rmdir unlink unlinkat rename renameat renameat2 symlink
    symlinkat truncate ftruncate poll ppoll select pselect6 sendto sendmsg recvfrom recvmsg
    getsockname munmap mremap brk mmap mprotect madvise membarrier clone wait4 exit exit_group futex
    set_robust_list rseq set_tid_address gettid getpid getppid getpgrp getpgid getsid getuid geteuid
    getgid getegid getresuid getresgid getgroups getrlimit setrlimit prlimit64 getrusage times
    sched_yield sched_getaffinity getcpu nanosleep clock_nanosleep clock_gettime clock_getres
    gettimeofday time alarm setitimer getitimer pause rt_sigaction rt_sigprocmask rt_sigreturn
    rt_sigpending rt_sigsuspend rt_sigtimedwait sigaltstack restart_syscall kill tkill tgkill uname
    getrandom arch_prctl fcntl ioctl prctl
    """,
    conditions={
        # No CLONE_NEW, CLONE_PARENT, CLONE_PIDFD. A thread, which shares memory, files, folder and
        # signals, is allowed; a process, which shares none of them nor waits, is asked for.
        "clone": (
            Condition(0, 0x7E029080, (0,)),
            Condition(0, 0x14F00, (0x10F00, 0)),
            Condition(0, 0x10000, (0x10000,), _ASK),
        ),
        "mmap": (_UNSHARED,),
        "madvise": (_ADVICE,),
        # F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_DUPFD_CLOEXEC: no locks.
        "fcntl": (Condition(1, _WHOLE, (0, 1, 2, 3, 4, 1030)),),
        # TCGETS, TIOCGWINSZ, FIONREAD, FIONBIO, FIONCLEX, FIOCLEX.
        "ioctl": (Condition(1, _WHOLE, (0x5401, 0x5413, 0x541B, 0x5421, 0x5450, 0x5451)),),
        # PR_SET_NAME, PR_GET_NAME.
        "prctl": (Condition(0, _WHOLE, (15, 16)),),
        # Of the calling process only.
        "prlimit64": (Condition(0, _WHOLE, (0,)),),
    },
    # The C library uses an older call where one is reported as missing.
    verdicts={"clone3": _refuse(_ENOSYS), "statx": _refuse(_ENOSYS), "seccomp": _ASK},
)
"""While a policy loads."""

_INSIDE: Final = """
munmap mremap brk mmap mprotect madvise exit exit_group futex gettid getpid sched_yield nanosleep
clock_nanosleep clock_gettime clock_getres gettimeofday time rt_sigprocmask rt_sigreturn sigaltstack
restart_syscall getrandom write rt_sigaction
"""
_WITHIN: Final = {
    "mmap": (Condition(3, 0x21, (0x20,)), Condition(2, 0x4, (0,))),  # anonymous, not executable
    "mprotect": (Condition(2, 0x4, (0,)),),
    "madvise": (_ADVICE,),
    "futex": (Condition(1, 0x80, (0x80,)),),  # FUTEX_PRIVATE_FLAG
    # Negative numbers are the clocks of other processes.
    **{
        name: (Condition(0, _WHOLE, tuple(range(8))),)
        for name in ("clock_nanosleep", "clock_gettime", "clock_getres")
    },
    "write": (Condition(0, _WHOLE, (1, 2)),),
    "sendto": (Condition(0, _WHOLE, (CHANNEL,)),),
    "recvfrom": (Condition(0, _WHOLE, (CHANNEL,)),),
    "recvmsg": (Condition(0, _WHOLE, (CHANNEL,)),),
}

FORKING: Final = Filter(
    allowed=_INSIDE
    + "sendto recvfrom recvmsg close dup2 dup3 clone wait4 set_robust_list rseq seccomp",
    conditions=_WITHIN,
    verdicts={},
)
"""Where lifts are forked from: it takes orders, and the process that watches decides on a fork."""

LIFT: Final = Filter(allowed=_INSIDE + "sendto recvfrom", conditions=_WITHIN, verdicts={})
"""In a lift."""

SET_MODE_FILTER: Final = 1
_NEW_LISTENER: Final = 8


def install(filter_: Filter, *, listen: bool = False) -> int:
    """Filter this process and its descendants, irrevocably.

    Return the listener, a file descriptor on which another process answers what the filter leaves
    to it, if one is asked for. The process must have renounced new privileges before
    (``PR_SET_NO_NEW_PRIVS``). Raise OSError if the kernel refuses, or the machine is unknown.
    """
    if _MACHINE not in _ARCHITECTURES:
        raise OSError(f"no filter of system calls is known for {_MACHINE}")
    program = filter_.program()
    buffer = ctypes.create_string_buffer(program, len(program))
    head = ctypes.create_string_buffer(HEAD.pack(len(program) // 8, ctypes.addressof(buffer)))
    flags = _NEW_LISTENER if listen else 0
    return syscall(NUMBERS["seccomp"], SET_MODE_FILTER, flags, head, what="seccomp")


HEAD: Final = struct.Struct("HxxxxxxQ")
"""What the kernel is handed: the number of instructions, and their address."""
