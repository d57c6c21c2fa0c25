"""What the tests of the hardware loop share: trials in the simulated laboratory."""

import time
from contextlib import ExitStack, closing, suppress

import numpy as np
import pytest
from colift.agents.hardware.decisions import Inline, Timed
from colift.agents.hardware.dry_run import DryArm
from colift.agents.hardware.loop import LoopSettings, run_trial
from colift.agents.hardware.nao.naoqi import NAMES, NaoqiArm, hand_heights
from colift.agents.hardware.nao.session import NaoqiSession
from colift.agents.hardware.operator import StopButton
from colift.agents.hardware.ports import RobotLostError
from colift.agents.hardware.trial_end import AfterDuration
from colift.agents.hardware.trial_log import LoggedTrial
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.hardware.laboratory import Conditions
from colift.benchmark.hardware.simulated import SimulatedLaboratory
from colift.benchmark.suites.catalogue import make_scenario


class Lab(SimulatedLaboratory):
    """The simulated laboratory, which notes what reaches its server, and the set-points."""

    def __init__(self, behaviour):
        self.button = StopButton()
        super().__init__(Conditions(scenario=make_scenario(behaviour, "S1")), self.button)
        self.sent = []
        self.angles = []

    def _pass(self, seconds):
        for _ in range(round(seconds / 0.01)):
            super()._pass(0.01)
            angles = self._laboratory.services["ALMotion"].getAngles(NAMES, False)
            self.angles.append((self.now(), angles))

    def calls(self, service, calls, *, within=0.15):
        self.sent += [(self.now(), *call) for call in calls]
        return super().calls(service, calls, within=within)

    def times(self, method):
        """Return when a method was called [s]."""
        return sorted({time for time, name, *_ in self.sent if name == method})

    def set_points(self, since=0.0):
        """Return the height of the hands by their set-points in each frame since a time [m]."""
        angles = [angles for time, angles in self.angles if time > since]
        return np.array(hand_heights(np.reshape(angles, (-1, len(NAMES)))))


class Patient(Timed):
    """Asks in a thread, and waits as long as a busy machine needs, but for a policy that sticks."""

    def decide(self, observation, budget):
        return super().decide(observation, budget if self._policy.sticks else 60.0)

    def await_answer(self):
        """Wait until the policy has answered."""
        while self._answers.empty():
            time.sleep(0.001)


class PatientSession(NaoqiSession):
    """Asks again: a busy machine may keep the emulator from answering in time."""

    def calls(self, service, calls, **options):
        for _ in range(20):
            with suppress(RobotLostError):
                return super().calls(service, calls, **options)
        return super().calls(service, calls, **options)


class Faulty(AfterDuration):
    """A trial's end that lets faults come: before the steps of these numbers."""

    def __init__(self, lab, duration, faults):
        super().__init__(duration=duration)
        self.lab, self.faults, self.came = lab, faults, None

    def over(self, log):
        fault = self.faults.pop(len(log.steps), None)
        if fault is not None:
            self.came = self.lab.now()
            fault(self.lab) if callable(fault) else self.lab.request(fault)
        return super().over(log)


class Trial:
    """A trial that was played in the simulated laboratory."""

    def __init__(self, lab, arm, trial, end):
        self.lab, self.arm, self.trial, self.came = lab, arm, trial, end.came
        self.log = trial.log

    @property
    def ended(self):
        """How long after the fault the arms were frozen [s]."""
        return self.lab.times("killAll")[0] - self.came

    def held_since(self, reason):
        """Return how long after the fault a reason first held the hands [s]."""
        return next(s.time for s in self.log.steps if s.hold == reason) - self.came

    def last_command(self):
        """Return how long after the fault the last command was given [s]."""
        return self.lab.times("setAngles")[-1] - self.came


@pytest.fixture
def play():
    """Play a trial in simulated time with a policy, by name or an object.

    A world takes 30 MB: only that of the last trial stays open, until the end of the test.
    """
    world = ExitStack()

    def trial(
        policy,
        *,
        faults=None,
        duration=5.0,
        decider=None,
        dry=False,
        behaviour="smooth",
        **settings,
    ):
        world.close()
        lab = world.enter_context(closing(Lab(behaviour)))
        arm = NaoqiArm(lab)
        # The rest heights without the sag under the table.
        lab.wait_until(0.3)
        lab.set_rest(0.0, arm.state().height)
        arm.say("Go!")
        agent = PolicySpec(text=policy).make() if isinstance(policy, str) else policy
        agent.reset(1)
        end = Faulty(lab, duration, dict(faults or {}))
        robot = DryArm(arm) if dry else arm
        log = run_trial(
            robot,
            lab,
            (decider or Inline)(agent),
            lab,
            settings=LoopSettings(**settings),
            end=end,
        )
        trial = LoggedTrial(
            policy=policy if isinstance(policy, str) else "",
            limits=robot.limits,
            weight_offset=arm.weight_offset,
            dry=dry,
            log=log,
        )
        return Trial(lab, arm, trial, end)

    with world:
        yield trial
