"""The laboratory in simulated time, inside this process: no network, no extra, no waiting.

The same adapter, loop and session run on it as on a robot. A call takes no time, and time passes
only while a caller waits, so that a trial is the same bit for bit, whatever else the machine does.
"""

from collections.abc import Callable, Sequence
from typing import Any

from colift.agents.agent import FRAME
from colift.agents.hardware.ends import Height, MarkerEnds
from colift.agents.hardware.nao.session import ANSWER_TIME
from colift.agents.hardware.operator import StopButton
from colift.agents.hardware.ports import CaptureLostError, RobotLostError, Sample
from colift.benchmark.hardware.joint_motion import MotionError
from colift.benchmark.hardware.laboratory import Conditions, Laboratory
from colift.benchmark.hardware.markers import MARKERS, REST_HEIGHT


class SimulatedLaboratory:
    """Clock, NAOqi and motion capture of a laboratory whose time passes when it is waited for.

    Parameters
    ----------
    conditions
        The emulated conditions.
    button
        The operator's stop.
    log
        Called with a line for each event.
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
        markers = [Height(marker, 3 * k + 2, 1.0) for k, marker in enumerate(MARKERS)]
        self._ends = MarkerEnds(markers[:2], markers[2:], REST_HEIGHT)
        self._laboratory = Laboratory(conditions, now=self.now, pause=self._pass, log=log)
        self.info: dict[str, object] = {"name": "world", "type": "MoCap", "rate_hz": 1 / FRAME}

    def now(self) -> float:
        """Return the simulated time [s]."""
        return self._frames * FRAME

    def wait_until(self, time: float) -> str | None:
        """Let the time pass; return the reason if the stop button was pressed, or None."""
        while self.now() < time - 1e-9 and self._button.reason is None:
            self._pass(FRAME)
        return self._button.reason

    def _pass(self, seconds: float) -> None:
        """Let the time pass, whether or not the stop button is pressed."""
        for _ in range(round(seconds / FRAME)):
            self._frames += 1
            self._faults = self._laboratory.frame()
            self._closed |= self._faults & {"disconnect", "stream-end"}
            for captured, row in self._laboratory.due():
                self._pending.append(self._ends.sample(captured, row))

    def request(self, fault: str) -> float:
        """Schedule a fault, whose time counts from now; return the time [s]."""
        return self._laboratory.request(fault)

    def drain(self) -> list[Sample]:
        """Return the frames that came since the last call; see :class:`.MotionCapture`."""
        frames, self._pending = self._pending, []
        if "stream-end" in self._closed:
            raise CaptureLostError("the stream is lost")
        return frames

    def set_rest(self, human_end: float, robot_end: float) -> None:
        """Subtract these heights [m] from the ends' heights."""
        self._ends.set_rest(human_end, robot_end)

    @property
    def unseen(self) -> str:
        """Return the markers not seen in the newest frame; see :class:`.MotionCapture`."""
        return self._ends.unseen

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
        silent = "silence" in self._faults and any(name == "getAngles" for name, *_ in calls)
        if silent or "hang" in self._faults:
            self._pass(within)
            raise RobotLostError(f"no answer from {self.url} within {within:g} s")
        module = self._laboratory.services[service]
        try:
            return [getattr(module, name)(*rest) for name, *rest in calls]
        except MotionError as error:
            raise RobotLostError(str(error)) from error

    def close(self) -> None:
        """Release the world."""
        self._laboratory.close()
