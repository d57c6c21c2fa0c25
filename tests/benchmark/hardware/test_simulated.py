"""The laboratory in simulated time, against the simulation that the suites are made of."""

from contextlib import ExitStack, closing

import numpy as np
import pytest
from colift.agents.hardware.decisions import Inline
from colift.agents.hardware.loop import LoopSettings
from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.operator import StopButton
from colift.agents.hardware.session import Session
from colift.agents.hardware.stops import Stop, StopTrialError
from colift.agents.hardware.trial_end import AfterLift
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.hardware.faults import Fault
from colift.benchmark.hardware.laboratory import Conditions
from colift.benchmark.hardware.simulated import SimulatedLaboratory
from colift.benchmark.hardware.trial import episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite

SMOOTH = make_scenario("smooth", "S1")
SEEDS = (0, 1, 2)


@pytest.fixture
def session():
    """Return what begins a session in the simulated laboratory, and lists what it tells."""
    with ExitStack() as worlds:

        def begin(**conditions):
            button, told = StopButton(), []
            lab = SimulatedLaboratory(Conditions(scenario=SMOOTH, **conditions), button)
            worlds.enter_context(closing(lab))
            made = Session(
                arm=NaoqiArm(lab),
                capture=lab,
                clock=lab,
                tell=told.append,
                confirm=told.append,
                button=button,
                asked_by=Inline,
            )
            return made, told

        yield begin


def lift(made, policy, number):
    """Play a lift and return its log."""
    return made.play(
        PolicySpec(text=policy).agent(),
        policy_seed(),
        number=number,
        settings=LoopSettings(),
        end=AfterLift(),
    )


@pytest.mark.slow
@pytest.mark.parametrize("policy", ["blend", "reactive", "task_model"])
def test_the_error_is_that_of_pure_simulation(session, policy):
    made, _ = session()
    made.set_up()
    logs = [lift(made, policy, number + 1) for number in SEEDS]
    made.finish(lambda: None)
    assert all(log.stop is None for log in logs)
    there = [episode(log, person="S1", number=k).scores for k, log in zip(SEEDS, logs, strict=True)]
    suite = Suite(name="here", scenarios=(SMOOTH,), seeds=SEEDS)
    here = [e.scores for e in run_suite(PolicySpec(text=policy), suite).episodes]
    for name in ("rmse_mm", "ldlj"):
        measured = np.mean([scores[name] for scores in there])
        simulated = np.mean([scores[name] for scores in here])
        assert measured == pytest.approx(simulated, rel=0.15)


def test_the_set_up_takes_hold_and_finds_zero(session):
    made, told = session()
    made.set_up()
    assert made.arm.weight_offset == pytest.approx(0.0042, abs=0.0005)
    state = made.arm.state()
    assert state.height == pytest.approx(0.0, abs=0.0005)
    made.clock.wait_until(made.clock.now() + 0.1)
    frames = made.capture.drain()[-5:]
    assert np.mean([frame.robot_end for frame in frames]) == pytest.approx(0.0, abs=0.0005)
    # The person's hand gives way a little where the hands have moved.
    assert np.mean([frame.human_end for frame in frames]) == pytest.approx(0.0, abs=0.005)
    assert [line for line in told if line.startswith("test move: the robot's end follows by 1.0")]
    made.finish(lambda: None)
    assert made.arm.session.call("ALMotion", "robotIsWakeUp") is False
    assert made.arm.state().stiffness == 0.0


@pytest.mark.parametrize(
    ("kind", "value", "told"),
    [
        ("nan", 0.0, "was not seen in 100 of 100 frames"),
        ("dropout", 0.0, "sends 0 frames a second"),
        ("drift", 0.02, r"end moves by \d\.\d mm \(sd\) where it should rest"),
        ("swap", 0.0, "the ends are taken for each other"),
    ],
)
def test_a_set_up_that_is_wrong_is_refused_with_what_to_do(session, kind, value, told):
    made, _ = session()
    made.capture.request(f"{kind}@0:1000:{value}")
    with pytest.raises(InputError, match=told):
        made.set_up()


def test_an_operator_may_stop_the_set_up(session):
    made, _ = session()
    made.button.press("the Enter key")
    with pytest.raises(StopTrialError, match="the Enter key") as stopped:
        made.set_up()
    assert stopped.value.stop is Stop.OPERATOR


def test_planned_faults_come_with_the_first_lift(session):
    fault = Fault(kind="dropout", start=1.0, duration=9.0, value=0.0)
    made, _ = session(faults=(fault,))
    made.set_up()
    log = lift(made, "hold", 1)
    assert log.stop is Stop.CAPTURE_LOST
    assert log.steps[-1].time - log.begin == pytest.approx(2.1, abs=0.15)
