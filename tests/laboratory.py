"""Emulated laboratories, in processes of their own, over the real protocols."""

import importlib
import os
import signal
import socket
import subprocess
import sys
import threading
import time
import uuid
from contextlib import ExitStack, closing, contextmanager

import pytest
from colift.agents.hardware.nao.session import NaoqiSession, quiet


class EmulatedLaboratory:
    """A process that runs ``colift nao emulate``, and what it prints."""

    def __init__(self, stream, *options):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.url = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        self.stream = stream
        command = [sys.executable, "-m", "colift.cli", "nao", "emulate"]
        self.process = subprocess.Popen(
            [*command, "--url", self.url, "--stream", stream, *options],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self.lines = []
        self._ready = threading.Event()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()
        self._ready.wait(60)
        if not self.lines:
            self._end()
            pytest.fail(f"the emulator does not start (exit code {self.process.returncode})")

    def _read(self):
        for line in self.process.stdout:
            self.lines.append(line.strip().partition(" ")[2])
            self._ready.set()
        self._ready.set()

    @property
    def place(self):
        """The options that find it."""
        return ("--robot", self.url, "--mocap", f"lsl:{self.stream}")

    def await_line(self, start, seconds=60, after=0):
        """Wait until a line that begins so has been printed, once more than ``after`` times."""
        end = time.monotonic() + seconds
        while sum(line.startswith(start) for line in self.lines) <= after:
            assert time.monotonic() < end, f"the emulator does not say {start!r}"
            time.sleep(0.02)

    def mark(self):
        """Return how many lines it has printed once all that was done before is among them."""
        with closing(NaoqiSession(self.url)) as session:
            mark = uuid.uuid4().hex
            session.call("ALMemory", "insertData", f"Test/{mark}", 0, within=60.0)
        self.await_line(f"memory Test/{mark}")
        return len(self.lines)

    def happened_since(self, before):
        """Return the lines from a mark on, but for marks and what is said of a lack of time."""
        self.mark()
        aside = ("behind the clock", "memory Test/")
        return [line for line in self.lines[before:] if not line.startswith(aside)]

    def close(self):
        """End it as an operator does."""
        self.process.send_signal(signal.SIGINT)
        try:
            assert self.process.wait(60) == 0
        finally:
            self._end()

    def _end(self):
        """Leave nothing of it, whatever state it is in."""
        self.process.kill()
        self.process.wait()
        self._reader.join()
        self.process.stdout.close()


@contextmanager
def emulators():
    """Yield what starts an emulated laboratory in a process of its own; all end with the body."""
    quiet()
    for package in ("qi", "pylsl"):
        # Where there is no library for this machine, pylsl says so by a RuntimeError.
        try:
            importlib.import_module(package)
        except (ImportError, RuntimeError) as error:
            pytest.skip(f"needs {package} ({error}): uv sync --all-extras")
    with ExitStack() as stack:
        count = iter(range(100))

        def start(*options):
            name = f"test-{os.getpid()}-{next(count)}-{time.monotonic_ns()}"
            made = EmulatedLaboratory(name, *options)
            stack.callback(made.close)
            return made

        yield start
