"""The emulator: a simulated NAO and motion capture, over the real protocols.

A libqi server offers the NAOqi services, an outlet of the Lab Streaming Layer the markers; between
them the simulated world runs in real time.
"""

import functools
import inspect
import threading
import time
from collections.abc import Callable
from typing import Any, Final

from colift.agents.agent import FRAME
from colift.agents.hardware.missing import import_optional
from colift.agents.hardware.nao.session import first_line, quiet
from colift.agents.hardware.operator import StopButton
from colift.base.errors import InputError
from colift.benchmark.hardware.laboratory import FAULTS, Conditions, Laboratory
from colift.benchmark.hardware.markers import MARKERS, Row
from colift.benchmark.hardware.services import Log

BEHIND: Final = 0.1
"""Longest lag of the emulator behind the clock [s]; beyond it, the lost time is skipped."""


class Emulator:
    """Runs a laboratory in real time.

    Parameters
    ----------
    conditions
        The emulated conditions.
    url
        Address at which the robot listens.
    stream
        Name of the motion-capture stream.
    log
        Called with a line for each event.

    Raises
    ------
    InputError
        If the robot cannot listen there, or libqi or pylsl is not installed.
    """

    def __init__(self, conditions: Conditions, *, url: str, stream: str, log: Log) -> None:
        self._log = log
        self._laboratory = Laboratory(conditions, now=time.monotonic, pause=_pause, log=log)
        self._alive = threading.Event()
        self._alive.set()
        self._session: Any = _serve(
            url,
            {
                name: service if name == FAULTS else behind(service, self._alive)
                for name, service in self._laboratory.services.items()
            },
        )
        self._outlet = Outlet(stream, source=url)

    def run(self, button: StopButton) -> None:
        """Run until the button is pressed."""
        begin, frame, behind = time.monotonic(), 0, 0
        while not button.wait(max(0.0, begin + frame * FRAME - time.monotonic())):
            if time.monotonic() - begin - frame * FRAME > BEHIND:
                begin = time.monotonic() - frame * FRAME
                behind += 1
                self._log(f"behind the clock, {behind} times")
            faults = self._laboratory.frame()
            for kind, event in (("silence", self._laboratory.answering), ("hang", self._alive)):
                if kind in faults:
                    event.clear()
                else:
                    event.set()
            if "disconnect" in faults:
                self._session.close()
            if "stream-end" in faults:
                self._outlet.close()
            for row in self._laboratory.due():
                self._outlet.send(row)
            frame += 1

    def close(self) -> None:
        """Close the connections and the world."""
        self._laboratory.answering.set()
        self._alive.set()
        self._session.close()
        self._outlet.close()
        self._laboratory.close()


def _pause(seconds: float) -> None:
    # libqi inspects the signatures of all members of a service, and a builtin has none.
    time.sleep(seconds)


def _serve(url: str, services: dict[str, Any]) -> Any:
    """Return a libqi session that offers the services."""
    quiet()
    qi = import_optional("qi")
    session = qi.Session()
    try:
        session.listenStandalone(url)
    except RuntimeError as error:
        raise InputError(f"cannot listen at {url}: {first_line(error)}") from error
    for name, service in services.items():
        session.registerService(name, service)
    return session


def behind(service: Any, gate: threading.Event) -> Any:
    """Return a service whose public methods wait until a gate opens, like a robot that hangs."""

    def waiting(method: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(method)
        def wait(self: Any, *arguments: Any) -> Any:
            gate.wait()
            return method(*arguments)

        # libqi checks the number of arguments.
        own = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
        signature = inspect.signature(method)
        wait.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=[own, *signature.parameters.values()]
        )
        return wait

    methods = {
        name: waiting(method)
        for name, method in inspect.getmembers(service, inspect.ismethod)
        if not name.startswith("_")
    }
    # Several threads call the methods: with one thread, a call that waits would block the others.
    return type(type(service).__name__, (), {"__qi_threading__": "multi", **methods})()


class Outlet:
    """Sends the table's markers over the Lab Streaming Layer.

    Parameters
    ----------
    name
        The stream's name.
    source
        Its source id, which tells it from others of its name.

    Raises
    ------
    InputError
        If pylsl is not installed.
    """

    def __init__(self, name: str, source: str) -> None:
        self._lsl = lsl = import_optional("pylsl")
        info = lsl.StreamInfo(name, "MoCap", 3 * len(MARKERS), 1 / FRAME, lsl.cf_double64, source)
        channels = info.desc().append_child("channels")
        for marker in MARKERS:
            for axis in "XYZ":
                channel = channels.append_child("channel")
                channel.append_child_value("label", f"{marker}_{axis}")
                channel.append_child_value("marker", marker)
                channel.append_child_value("type", f"Position{axis}")
                channel.append_child_value("unit", "meters")
        self._outlet: Any = lsl.StreamOutlet(info)

    def send(self, row: Row) -> None:
        """Send a frame, stamped by the monotonic clock, unless the stream is closed."""
        captured, values = row
        if self._outlet is not None:
            shift = self._lsl.local_clock() - time.monotonic()
            self._outlet.push_sample(values, captured + shift)

    def close(self) -> None:
        """Close the stream."""
        self._outlet = None
