"""Calls to a NAOqi over libqi, none of which waits forever."""

import os
import sys
import time
from collections.abc import Sequence
from typing import Any, Final, NoReturn

from colift.agents.hardware.missing import import_optional
from colift.agents.hardware.ports import RobotLostError
from colift.base.errors import InputError

CONNECT_TIME: Final = 5.0
"""Longest time to connect [s]."""

ANSWER_TIME: Final = 0.15
"""Longest time for the answer to a call that does not block [s]; a wired network takes 1 to 5 ms, a
wireless one up to 50 ms."""

PULSE: Final = 0.3
"""Interval at which the robot is asked whether it still answers while a call blocks [s]."""


class NaoqiSession:
    """A connection to a robot's NAOqi.

    Parameters
    ----------
    url
        Address at which NAOqi listens, such as ``tcp://nao.local:9559``.

    Raises
    ------
    InputError
        If there is no such robot, or libqi is not installed.
    """

    def __init__(self, url: str) -> None:
        quiet()
        qi = import_optional("qi")
        self.url = url
        self._session = qi.Session()
        self._services: dict[str, Any] = {}
        try:
            self._session.connect(url, _async=True).value(round(1000 * CONNECT_TIME))
        except RuntimeError as error:
            raise InputError(
                f"no NAOqi at {url}: {first_line(error)}; is the robot on, and the address right?"
            ) from error

    @property
    def connected(self) -> bool:
        """Whether the connection is up, as far as libqi has noticed."""
        return bool(self._session.isConnected())

    def has(self, service: str) -> bool:
        """Return whether NAOqi offers a service."""
        try:
            self._service(service)
        except RobotLostError:
            return False
        return True

    def call(self, service: str, method: str, *arguments: Any, within: float = ANSWER_TIME) -> Any:
        """Call a method and return its result, waiting at most ``within`` [s].

        Raises
        ------
        RobotLostError
            If there is no answer in time, no connection, or the robot refuses the call.
        """
        return self.calls(service, [(method, *arguments)], within=within)[0]

    def calls(
        self, service: str, calls: Sequence[tuple[Any, ...]], *, within: float = ANSWER_TIME
    ) -> list[Any]:
        """Make several calls at the same time and return their results.

        Raises
        ------
        RobotLostError
            As :meth:`call`.
        """
        module = self._service(service)
        try:
            deadline = time.monotonic() + within
            futures = [getattr(module, name)(*rest, _async=True) for name, *rest in calls]
            if within > ANSWER_TIME:
                self._await(futures, deadline)
            return [future.value(_milliseconds_to(deadline)) for future in futures]
        except (RuntimeError, AttributeError) as error:
            names = ", ".join(dict.fromkeys(f"{service}.{name}" for name, *_ in calls))
            message = first_line(error)
            if "timeout" in message:
                message = f"no answer within {within:g} s"
            raise RobotLostError(f"{names} at {self.url}: {message}") from error

    def _await(self, futures: Sequence[Any], deadline: float) -> None:
        """Wait for calls that may take long, while the robot still answers in between."""
        for future in futures:
            while not future.isFinished() and time.monotonic() < deadline:
                future.wait(min(round(1000 * PULSE), _milliseconds_to(deadline)))
                if not future.isFinished():
                    self.call("ALMotion", "robotIsWakeUp")

    def _service(self, name: str) -> Any:
        if name not in self._services:
            try:
                future = self._session.service(name, _async=True)
                self._services[name] = future.value(round(1000 * CONNECT_TIME))
            except RuntimeError as error:
                raise RobotLostError(f"no {name} at {self.url}: {first_line(error)}") from error
        return self._services[name]

    def close(self) -> None:
        """Close the connection."""
        self._session.close()


def _milliseconds_to(deadline: float) -> int:
    return max(0, round(1000 * (deadline - time.monotonic())))


def quiet() -> None:
    """Let libqi log errors only: at every start it warns of an Application that is not needed."""
    os.environ.setdefault("QI_LOG_LEVEL", "2")


def leave(code: int) -> NoReturn:
    """End a process that has used libqi, without running libqi's destructors.

    The destructors end threads that may still be at work; the process then aborts at random
    ("terminate called").
    """
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


def first_line(error: BaseException) -> str:
    """Return the message of a libqi error, without the remote side's stack."""
    lines = [line.strip() for line in str(error).partition("\nAt:")[0].splitlines()]
    return " ".join(line for line in lines if line)
