"""What the tests of several packages share."""

import os
import signal
import socket
import subprocess
import sys
import threading
import time
from contextlib import ExitStack

import pytest
from colift.benchmark.executors import JOBS
from colift.benchmark.loopback import loopback_cluster

# A shell lets what it starts in the background ignore Ctrl-C; so would all that the tests start.
signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_xdist_auto_num_workers() -> int:
    """One more than there are processors: many tests wait for what they have started."""
    return len(os.sched_getaffinity(0)) + 1


@pytest.fixture(scope="session", autouse=True)
def own_environment(tmp_path_factory):
    """Keep what is cached from the user's own; one worker is enough where tests share the cores."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        patched.setenv(JOBS, "1")
        yield


@pytest.fixture(scope="module")
def dask_address():
    """Start a Dask scheduler and two worker processes, and return the scheduler's address.

    They end with the module: they are busy also when nobody uses them.
    """
    with loopback_cluster(2) as address:
        yield address


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
        assert self._ready.wait(60), "the emulator does not start"

    def _read(self):
        for line in self.process.stdout:
            self.lines.append(line.strip().partition(" ")[2])
            self._ready.set()

    @property
    def place(self):
        """The options that find it."""
        return ("--robot", self.url, "--mocap", f"lsl:{self.stream}")

    def await_line(self, start, seconds=60):
        """Wait until a line that begins so has been printed."""
        end = time.monotonic() + seconds
        while not any(line.startswith(start) for line in self.lines):
            assert time.monotonic() < end, f"the emulator does not say {start!r}"
            time.sleep(0.02)

    def close(self):
        """End it as an operator does."""
        self.process.send_signal(signal.SIGINT)
        self.process.wait(60)
        self._reader.join()
        self.process.stdout.close()


@pytest.fixture(scope="session")
def lsl_on_loopback(tmp_path_factory):
    """Keep the streams of the tests on this machine, and away from others."""
    path = tmp_path_factory.mktemp("lsl") / "lsl_api.cfg"
    path.write_text(
        "[lab]\nKnownPeers = {127.0.0.1}\n"
        f"SessionID = colift-tests-{os.getpid()}\n"
        "[multicast]\nResolveScope = machine\n[log]\nlevel = -2\n"
    )
    before = os.environ.get("LSLAPICFG")
    os.environ["LSLAPICFG"] = str(path)
    yield
    if before is None:
        del os.environ["LSLAPICFG"]
    else:
        os.environ["LSLAPICFG"] = before


@pytest.fixture(scope="module")
def emulate(lsl_on_loopback):
    """Start an emulated laboratory in a process of its own, over the real protocols."""
    with ExitStack() as stack:
        count = iter(range(100))

        def start(*options):
            name = f"test-{os.getpid()}-{next(count)}-{time.monotonic_ns()}"
            made = EmulatedLaboratory(name, *options)
            stack.callback(made.close)
            return made

        yield start
