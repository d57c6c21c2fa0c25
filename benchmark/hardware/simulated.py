"""The laboratory in simulated time, inside this process: no network, no extra, no waiting.

The same adapter, loop and session work on it as on a robot. A call takes no time, and nothing
happens but while somebody waits: so a trial is the same bit for bit, whatever else goes on.
"""

from collections.abc import Callable, Sequence
from typing import Any

from ...agents.agent import FRAME
from ...agents.hardware.naoqi_session import ANSWER_TIME
from ...agents.hardware.operator import StopButton
from ...agents.hardware.ports import CaptureLostError, RobotLostError, Sample
from .joint_motion import MotionError
from .laboratory import Conditions, Laboratory
from .markers import REST_HEIGHT


class SimulatedLaboratory:
    """Clock, NAOqi and motion capture of a laboratory whose time passes when it is waited for.

    Parameters
    ----------
    conditions
        What is emulated.
    button
        The operator's stop.
    log
        Called with a line for each thing that happens.
    """

    url = "world"

    def __init__(
        self,
        conditions: Conditions,
        button: StopButton | None = None,
        log: Callable[[str], None] = lambda line: None,
    ) -> None:
        self._button = button or StopButton()
        self._frames = 0
        self._faults: set[str] = set()
        self._closed: set[str] = set()
        self._pending: list[Sample] = []
        self._rest = REST_HEIGHT, REST_HEIGHT
        self._laboratory = Laboratory(conditions, now=self.now, pause=self._pass, log=log)
        self.info: dict[str, object] = {"name": "world", "type": "MoCap", "rate_hz": 1 / FRAME}

    def now(self) -> float:
        """Return the simulated time [s]."""
        return self._frames * FRAME

    def wait_until(self, time: float) -> str | None:
        """Let the time pass; return how the stop button was pressed, or None."""
        while self.now() < time - 1e-9 and self._button.reason is None:
            self._pass(FRAME)
        return self._button.reason

    def _pass(self, seconds: float) -> None:
        """Let the time pass, whoever presses a button."""
        for _ in range(round(seconds / FRAME)):
            self._frames += 1
            self._faults = self._laboratory.frame()
            self._closed |= self._faults & {"disconnect", "stream-end"}
            self._pending += map(self._sample, self._laboratory.due())

    def _sample(self, row: tuple[float, list[float]]) -> Sample:
        captured, values = row
        h1, h2, r1, r2 = values[2::3]
        human, robot = self._rest
        return Sample(captured, (h1 + h2) / 2 - human, (r1 + r2) / 2 - robot)

    def request(self, fault: str) -> float:
        """Let a fault come, whose time counts from now; return the time [s]."""
        return self._laboratory.request(fault)

    def drain(self) -> list[Sample]:
        """Return the frames that came since the last call; see :class:`.MotionCapture`."""
        frames, self._pending = self._pending, []
        if "stream-end" in self._closed:
            raise CaptureLostError("the stream is lost")
        return frames

    def set_rest(self, human_end: float, robot_end: float) -> None:
        """Displace the zero of the ends' heights [m]."""
        human, robot = self._rest
        self._rest = human + human_end, robot + robot_end

    def has(self, service: str) -> bool:
        """Return whether the robot offers a service."""
        return service in self._laboratory.services

    def call(self, service: str, method: str, *arguments: Any, within: float = ANSWER_TIME) -> Any:
        """Call a method; see :class:`.Naoqi`."""
        return self.calls(service, [(method, *arguments)], within=within)[0]

    def calls(
        self, service: str, calls: Sequence[tuple[Any, ...]], *, within: float = ANSWER_TIME
    ) -> list[Any]:
        """Call several methods; see :class:`.Naoqi`."""
        if "disconnect" in self._closed:
            raise RobotLostError(f"no connection to {self.url}")
        if "silence" in self._faults and any(name == "getAngles" for name, *_ in calls):
            self._pass(within)
            raise RobotLostError(f"no answer of {self.url} within {within:g} s")
        module = self._laboratory.services[service]
        try:
            return [getattr(module, name)(*rest) for name, *rest in calls]
        except MotionError as error:
            raise RobotLostError(str(error)) from error

    def close(self) -> None:
        """Release the world."""
        self._laboratory.close()
