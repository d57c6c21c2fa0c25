"""A laboratory that is not there: a NAO and a motion capture, over the real protocols.

A libqi server offers the NAOqi services, an outlet of the Lab Streaming Layer the markers; between
them the simulated world runs in real time.
"""

import threading
import time
from typing import Any, Final

from ...agents.agent import FRAME
from ...agents.errors import InputError
from ...agents.hardware.missing import import_optional
from ...agents.hardware.nao.session import first_line, quiet
from ...agents.hardware.operator import StopButton
from .gate import behind
from .laboratory import FAULTS, Conditions, Laboratory
from .outlet import Outlet
from .services import Log

BEHIND: Final = 0.1
"""How far behind the clock the emulator may be [s]; further, it lets the time pass."""


class Emulator:
    """Runs a laboratory in real time.

    Parameters
    ----------
    conditions
        What is emulated.
    url
        Where the robot listens.
    stream
        Name of the motion-capture stream.
    log
        Called with a line for each thing that happens.

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
        self._outlet = Outlet(stream)

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
    # libqi looks at the signatures of all that a service holds, and a builtin has none.
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
