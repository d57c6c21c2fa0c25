"""A session in the laboratory: set-up, trials, and return to rest."""

import gc
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import Agent, RobotObservation
from colift.agents.hardware import setup
from colift.agents.hardware.decisions import Decider, Timed
from colift.agents.hardware.dry_run import DryArm
from colift.agents.hardware.frames import drained
from colift.agents.hardware.loop import LoopSettings, run_trial
from colift.agents.hardware.nao.health import refuse_unless_well
from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.operator import StopButton, key_stops
from colift.agents.hardware.plausibility import seen
from colift.agents.hardware.ports import Clock, HandLimits, RobotArm, RobotLostError, TableCapture
from colift.agents.hardware.release import release
from colift.agents.hardware.stops import Stop, StopTrialError, losses_stop
from colift.agents.hardware.trial_end import TrialEnd
from colift.agents.hardware.trial_log import TrialLog
from colift.base.errors import InputError, error_text

READY: Final = 0.015
"""Largest height of an end at which a trial may begin [m]."""

GO: Final = "Go"
"""Spoken signal at the start of a trial."""


@dataclass(frozen=True, kw_only=True)
class Session:
    """A robot, a motion capture, a clock, and the dialogue with the operator.

    Every method raises :class:`.StopTrialError` on a stop, and :class:`.InputError` if the set-up
    is wrong.
    """

    arm: NaoqiArm
    capture: TableCapture
    clock: Clock
    tell: Callable[[str], None]
    """Shows a line to the operator."""
    confirm: Callable[[str], None]
    """Asks the operator to do something, and waits until it is done."""
    button: StopButton
    """The operator's stop, which the clock listens to."""
    dry: bool = False
    """Whether nothing may move."""
    asked_by: Callable[[Agent], Decider] = Timed
    """Makes the decider of a policy; in real time, one with a thread of its own."""

    @property
    def robot(self) -> RobotArm:
        """The arm that the trials use."""
        return DryArm(self.arm) if self.dry else self.arm

    @property
    def limits(self) -> HandLimits:
        """Limits of the trials."""
        return self.robot.limits

    def set_up(self) -> None:
        """Take hold of the table, find zero, and check that the ends move as they should."""
        if self.dry:
            self.tell("dry run: nothing moves; the weight offset and the test move are left out")
            self._zero()
            return
        with losses_stop():
            refuse_unless_well(self.arm)
            self.confirm("Clear the space around the robot's arms: they move to the rest posture.")
            with self._stoppable():
                self.arm.take_hold()
            self.confirm("Put the table into its hands, hold the other end level, and keep still.")
            sag = setup.measure_sag(self.arm, self.clock)
            self.arm.weight_offset += sag
            self.tell(f"weight offset: {1000 * sag:.1f} mm")
            setup.move_to(self.arm, self.clock, 0.0)
            setup.wait(self.clock, 0.3)
            self._zero()
            self.confirm(f"Keep still: the hands move up by {1000 * setup.TEST_MOVE:.0f} mm.")
            direction = setup.measure_direction(self.arm, self.capture, self.clock)
            self.tell(
                f"test move: the robot's end follows by {direction.robot_end:.2f}, the human's by "
                f"{direction.human_end:.2f} m per m"
            )

    @contextmanager
    def _stoppable(self) -> Iterator[None]:
        """Freeze the arms at once if the operator stops while a call moves them."""
        over = threading.Event()

        def stop() -> None:
            while not over.wait(0.05):
                if self.button.reason is not None:
                    self.arm.stop()

        watcher = threading.Thread(target=stop, name="stop", daemon=True)
        watcher.start()
        try:
            yield
        except RobotLostError:
            # A call that was cut short fails.
            setup.wait(self.clock, 0.0)
            raise
        finally:
            over.set()
            watcher.join()
        setup.wait(self.clock, 0.0)

    def _zero(self) -> None:
        """Take the ends' present heights as zero."""
        rest = setup.measure_rest(self.capture, self.clock)
        self.capture.set_rest(rest.human_end, rest.robot_end)
        self.tell(
            f"rest heights: human's end {rest.human_end:.4f} m, robot's end "
            f"{rest.robot_end:.4f} m; noise {1000 * rest.noise:.2f} mm, "
            f"{rest.rate:.0f} frames a second"
        )

    def play(
        self,
        policy: AbstractContextManager[Agent],
        seed: int,
        *,
        number: int,
        settings: LoopSettings,
        end: TrialEnd,
    ) -> TrialLog:
        """Play one trial with a new policy object; return its log, also if it was stopped."""
        robot = self.robot
        with policy as agent:
            warm_up(agent, seed)
            with losses_stop():
                if not self.dry:
                    refuse_unless_well(self.arm)
                self._ready()
                decider = self.asked_by(agent)
                self.arm.say(f"Lift {number}. {GO}!")
            try:
                with _undisturbed(), key_stops(self.button):
                    return run_trial(
                        robot, self.capture, decider, self.clock, settings=settings, end=end
                    )
            finally:
                decider.close()

    def _ready(self) -> None:
        """Bring the hands to rest, and wait until the table rests."""
        if not self.dry:
            setup.move_to(self.arm, self.clock, 0.0)
        for _ in range(100):
            setup.wait(self.clock, 0.2)
            frames = list(filter(seen, drained(self.capture, self.clock.now()).frames))
            if frames and max(map(abs, frames[-1][1:])) < READY:
                return
        unseen = self.capture.unseen
        raise InputError(
            "the table does not come to rest within "
            f"{1000 * READY:.0f} mm of its rest height{unseen and ': '}{unseen}"
        )

    def stop(self, stop: StopTrialError) -> None:
        """Freeze the hands for good, and show the reason."""
        self.tell(f"STOPPED ({stop.stop.name}): {stop.reason}")
        if not self.dry and not self.arm.stopped:
            self.arm.stop()

    def finish(self, taken_out: Callable[[], None]) -> None:
        """Release the arms smoothly, and bring the robot to rest; see :func:`.release.release`.

        Parameters
        ----------
        taken_out
            Waits until the operator has taken the table out of the hands.
        """
        release(self.arm, self.clock, self.tell, taken_out)


def warm_up(policy: Agent, seed: int) -> None:
    """Reset a policy for a trial, such that it is not late at its first step.

    Work that it does only once, such as importing, is done here, on a meaningless observation.

    Raises
    ------
    StopTrialError
        If it fails.
    """
    try:
        # In a thread that ends: a sandboxed policy pins its caller's thread to one processor for a
        # while.
        with ThreadPoolExecutor(1) as aside:
            aside.submit(_rehearse, policy, seed).result()
    except (Exception, SystemExit) as error:
        raise StopTrialError(
            Stop.POLICY, f"the policy fails at once: {error_text(error)}"
        ) from error


def _rehearse(policy: Agent, seed: int) -> None:
    policy.reset(seed)
    policy.act(np.zeros(len(RobotObservation)))
    policy.reset(seed)


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Keep the garbage collector from interrupting the loop."""
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
