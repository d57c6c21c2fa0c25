"""The gate: what the process that watches checks before a policy sees a lift.

A policy's process cannot be trusted to close its own doors: the policy may have changed everything
in it. The filter of system calls therefore leaves two calls to the process that watches, which is
colift's alone: to make a process, and to install a further filter. A further filter is allowed if
it is, byte by byte, the one that is due, and if nothing else is left: one process, one thread, no
file but the connection and the output, no shared memory, no page that would have to be read.
"""

import os
import signal
import struct
import time
from dataclasses import dataclass
from typing import Final

from colift.agents.sandbox.guest import filters
from colift.agents.sandbox.guest.filters import CHANNEL, FORKING, HEAD, LIFT, NUMBERS, Filter
from colift.agents.sandbox.guest.pages import Pages, mappings
from colift.agents.sandbox.guest.processes import Processes

_RECEIVE, _ANSWER = 0xC0502100, 0xC0182101
"""The listener's controls ``SECCOMP_IOCTL_NOTIF_RECV`` and ``SECCOMP_IOCTL_NOTIF_SEND``."""
_QUESTION: Final = struct.Struct("=QIIiIQ6Q")
"""``struct seccomp_notif``: id, process, flags, call, architecture, address, arguments."""
_REPLY: Final = struct.Struct("=QqiI")
"""``struct seccomp_notif_resp``: id, value, error, flags."""
_CONTINUE: Final = 1
_EPERM: Final = 1

_FORKS: Final = 2
"""Processes that may be made for a lift: its own, and that which makes it and ends at once."""

_SETTLE_SECONDS: Final = 5.0
"""Time for what must be gone to go [s]."""


def _control(listener: int, request: int, content: bytes | bytearray) -> None:
    import fcntl  # Windows, where this file is only read, has none.

    fcntl.ioctl(listener, request, content)


class RefusedError(Exception):
    """A condition of the gate that does not hold."""


class MachineError(Exception):
    """What the gate needs of this machine, and does not get."""


@dataclass
class Gate:
    """The answers to the questions of a filter.

    The policy is loaded, then the gate is closed behind it (:data:`.FORKING`); from then on lifts
    are forked, and closed one by one (:data:`.LIFT`).
    """

    listener: int
    """On which the questions come."""
    processes: Processes
    loaded: int
    """The process in which the policy is loaded."""
    connection: int
    """Inode of its end of the connection."""
    output: int
    """Inode of its output."""
    fresh: frozenset[str]
    """Devices of the file systems in which the policy may write, as ``major:minor``."""
    pages: Pages
    """Those that are kept in memory."""
    doors: tuple[int, ...]
    """A handle by which a process enters the control group of lifts, where there is one."""
    closed: bool = False
    """Whether the policy is loaded, and its gate closed."""
    lift: int | None = None
    """The process of the lift; None if there is none, or not yet."""
    _forks: int = 0

    def order(self) -> None:
        """Let a lift be forked."""
        self._forks = _FORKS if self.closed else 0

    def forget(self) -> None:
        """Forget the lift, whose process has ended."""
        self._forks, self.lift = 0, None

    def answer(self) -> str:
        """Answer a question, and return a report.

        It is ``closed``, ``refused REASON``, ``fault REASON``, or nothing.
        """
        question = bytearray(_QUESTION.size)
        try:
            _control(self.listener, _RECEIVE, question)
        except OSError:
            return ""  # Its process has ended, or was interrupted and will ask again.
        serial, process, _, call, _, _, *arguments = _QUESTION.unpack(question)
        try:
            if call == NUMBERS["clone"]:
                return self._fork(serial)
            operation, flags, address, *_ = arguments
            if operation != filters.SET_MODE_FILTER or flags:
                raise RefusedError
            return self._close(serial, process, address)
        except (RefusedError, MachineError, OSError, struct.error) as error:
            try:
                self._reply(serial, _EPERM)
            except OSError:
                return ""  # Its process has ended, or was interrupted and will ask again.
            if isinstance(error, MachineError):
                return f"fault {error}"
            return f"refused {error}" if isinstance(error, RefusedError) and str(error) else ""

    def _reply(self, serial: int, error: int = 0) -> None:
        """Let a call happen, or fail; raise OSError if its process no longer waits."""
        flags = 0 if error else _CONTINUE
        _control(self.listener, _ANSWER, _REPLY.pack(serial, 0, -error, flags))

    def _fork(self, serial: int) -> str:
        """Let a process be made for a lift that was ordered."""
        if self._forks == 0:
            raise RefusedError
        self._reply(serial)
        self._forks -= 1
        return ""

    def _close(self, serial: int, process: int, address: int) -> str:
        """Let a process install the filter that is due, if all else is as it must be."""
        if not self.closed and process == self.loaded:
            self._check_program(process, address, FORKING)
            self._check_alone({process})
            self._check_files(process, self.connection, self.output)
            self._check_memory(process)
            self._check_program(process, address, FORKING)  # A thread may have changed it.
            self._enter_group(process)
            self._install(serial, process)
            self.closed = True
        elif self.closed and self.lift is None and self._forks == 0 and process != self.loaded:
            self._check_program(process, address, LIFT)
            self._settle(process)
            self._check_program(process, address, LIFT)
            self._install(serial, process)
            self.lift = process
            # It would see how long the steps of the lift take.
            os.kill(self.loaded, signal.SIGSTOP)
        else:
            raise RefusedError
        return "closed"

    def _check_program(self, process: int, address: int, due: Filter) -> None:
        """Check that a process installs the filter that is due.

        It waits for the answer, and shares its memory with no other process, which the filter does
        not allow. Once it is known to have one thread, what is read here is what the kernel will
        read.
        """
        program = due.program()
        with self.processes.opened(process, "mem") as memory:
            length, place = HEAD.unpack(os.pread(memory, HEAD.size, address))
            if length * 8 != len(program) or os.pread(memory, len(program), place) != program:
                raise RefusedError

    def _settle(self, process: int) -> None:
        """Check that the lift and what it was forked from are all there is, when both have settled.

        The latter must not keep the connection of the lift, and the lift must have its own. Nor may
        it be the parent of the lift: a parent is told the exit, the memory and the times of its
        children. The one that watches is the parent of both.
        """
        end = time.monotonic() + _SETTLE_SECONDS
        while True:
            try:
                self._check_alone({self.loaded, process})
                self._check_files(self.loaded, self.connection, self.output)
                self._check_files(process, None, None)
            except RefusedError:
                if time.monotonic() > end:
                    raise
                time.sleep(0.0002)
            else:
                return

    def _check_alone(self, expected: set[int]) -> None:
        """Check that these are all processes, with one thread each and the same parent."""
        found = self.processes.all()
        if found.keys() != expected:
            raise RefusedError(f"processes {len(found)}")
        if threads := sum(each.threads for each in found.values()) - len(expected):
            raise RefusedError(f"threads {threads}")
        if len({each.parent for each in found.values()}) > 1:
            raise RefusedError("parent")

    def _check_files(self, process: int, connection: int | None, output: int | None) -> None:
        """Check the open files of a process: those of the loaded one, or for None, others."""
        files = self.processes.files(process)
        own = files.pop(CHANNEL, ""), files.pop(1, ""), files.pop(2, "")
        loaded = f"socket:[{self.connection}]", f"pipe:[{self.output}]"
        if connection is None:
            sound = own[1] == own[2] != loaded[1] and own[0] != loaded[0]
            sound = sound and own[0].startswith("socket:") and own[1].startswith("pipe:")
        else:
            sound = own == (f"socket:[{connection}]", *2 * (f"pipe:[{output}]",))
        if not sound or files != {0: os.devnull}:
            raise RefusedError("files")

    def _check_memory(self, process: int) -> None:
        """Check that no memory is shared, and keep all pages of mapped files in memory."""
        for each in mappings(self.processes.read(process, "maps")):
            if each.shared:
                raise RefusedError("shared memory")
            if each.device in self.fresh:
                raise RefusedError(f"mapping {each.path}")  # Its name may be another's by now.
            try:
                self.pages.keep(each)
            except OSError:
                raise RefusedError(f"mapping {each.path}") from None

    def _enter_group(self, process: int) -> None:
        """Move a process, and all that will be forked from it, to the control group of lifts."""
        for door in self.doors:
            try:
                os.write(door, str(process).encode())
            except OSError as error:
                raise MachineError(f"control group of lifts: {error}") from None

    def _install(self, serial: int, process: int) -> None:
        """Let a process install its filter; raise RefusedError if the kernel then refuses it."""
        before = self._filters(process)
        self._reply(serial)
        end = time.monotonic() + _SETTLE_SECONDS
        while self._filters(process) == before:
            if time.monotonic() > end:
                raise RefusedError("filter")
            time.sleep(0.00005)

    def _filters(self, process: int) -> int:
        """Return the number of filters of a process, as Linux 5.9 and later tell it."""
        words = self.processes.read(process, "status")
        return int(words.partition(b"Seccomp_filters:")[2].split()[0])
