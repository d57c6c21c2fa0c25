"""The task: what is seen, what an action does, when it ends, what it pays."""

import math

import numpy as np
import pytest
from colift.agents.agent import HumanObservation, RobotObservation
from colift.agents.humans import SECOND_PERSON
from colift.agents.senses import MOCAP_NOISE
from colift.base.errors import InputError
from colift.benchmark.environment import parallel_env
from colift.benchmark.episode.lift import Lift
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.world.interface import since_reset

NO_CHANGE = np.zeros(1)


def lift(**settings):
    made = Lift(make_scenario(settings.pop("behaviour", "smooth"), **settings))
    made.reset(7)
    return made


def follow(made, steps):
    """Advance with the scripted human and a robot that copies what it sees; return the views."""
    human = made.scripted_human()
    views = []
    for _ in range(steps):
        view = made.partner_observation()
        views.append(view)
        change = view[RobotObservation.HUMAN_END] - view[RobotObservation.HAND_COMMAND]
        made.step(human.act(made.human_observation()), np.array([change]))
    return np.array(views)


class TestRobotView:
    @pytest.mark.parametrize("latency", [0.0, 0.05, 0.1, 0.2])
    def test_motion_capture_is_as_old_as_the_latency_and_the_hand_is_fresh(self, latency):
        made = lift(latency=latency)
        views = follow(made, 30)
        ends = since_reset(made.world.human_end)
        frames = np.arange(10, 30) * 10 - 1 - round(latency / 0.01)
        seen = views[10:, RobotObservation.HUMAN_END]
        assert np.abs(seen - ends[frames]).max() < 6 * MOCAP_NOISE
        hands = since_reset(made.world.robot_end)[np.arange(10, 30) * 10 - 1]
        assert np.abs(views[10:, RobotObservation.HAND_HEIGHT] - hands).max() < 1e-3

    def test_its_noise_has_the_precision_of_the_motion_capture(self):
        made = lift(latency=0.0)
        errors = []
        for seed in range(12):
            made.reset(seed)
            views = follow(made, 55)
            for column, history in (
                (RobotObservation.HUMAN_END, made.world.human_end),
                (RobotObservation.ROBOT_END, made.world.robot_end),
            ):
                true = since_reset(history)[np.arange(1, 55) * 10 - 1]
                errors.append(views[1:, column] - true)
        assert np.std(errors) == pytest.approx(MOCAP_NOISE, rel=0.1)
        assert abs(np.mean(errors)) < MOCAP_NOISE / 8

    def test_what_a_policy_does_to_its_observation_changes_nothing(self):
        first, second = lift(), lift()
        for made in (first, second):
            view = made.partner_observation()
            if made is first:
                view[:] = 9.0
            made.step(np.zeros(10), NO_CHANGE)
        assert first.partner_observation().tobytes() == second.partner_observation().tobytes()


class TestHumanView:
    def test_is_laid_out_as_its_index_table_says(self):
        made = lift(subject="S4")
        follow(made, 25)
        view, world, subject = made.human_observation(), made.world, made.scenario.subject
        own = since_reset(world.human_end)
        other = since_reset(world.robot_end)
        force = since_reset(world.human_force)
        seen = 250 - round(subject.visual_delay / 0.01)
        felt = 250 - round(subject.haptic_delay / 0.01)
        assert view[HumanObservation.OWN_HEIGHT].tolist() == own[240:250].tolist()
        speed = np.gradient(own, 0.01)[241:249]
        assert view[HumanObservation.OWN_VELOCITY][1:9] == pytest.approx(speed, abs=0.02)
        assert view[HumanObservation.OTHER_END].tolist() == other[seen - 10 : seen].tolist()
        assert view[HumanObservation.HAND_FORCE].tolist() == force[felt - 10 : felt].tolist()
        assert view[HumanObservation.TARGET].tolist() == made.plan.target[250:260].tolist()
        assert view[HumanObservation.TIME] == pytest.approx(2.5)

    def test_a_second_human_is_not_told_the_plan(self):
        made = lift(partner="human")
        human = made.scripted_human()
        for _ in range(25):
            made.step(human.act(made.human_observation()), np.zeros(10))
        view = made.partner_observation()
        assert view.shape == made.human_observation().shape
        others = since_reset(made.world.human_end)
        seen = 250 - 1 - round(SECOND_PERSON.visual_delay / 0.01)
        assert set(view[HumanObservation.TARGET].tolist()) == {others[seen]}


class TestAction:
    def test_the_command_ramps_over_the_period(self):
        made = lift()
        made.step(np.zeros(10), np.array([0.03]))
        assert made.command == pytest.approx(0.03)
        rise = np.diff(since_reset(made.world.robot_end))
        assert (rise > 0).all()
        assert rise.max() < 0.006

    @pytest.mark.parametrize(("asked", "done"), [(0.5, 0.04), (-0.5, -0.03), (0.04, 0.04)])
    def test_is_held_to_the_hands_speed_and_stroke(self, asked, done):
        made = lift()
        made.step(np.zeros(10), np.array([asked]))
        assert made.command == pytest.approx(done)

    def test_the_speed_limit_is_the_same_at_a_shorter_period(self):
        made = lift(control_period=0.02)
        made.step(np.zeros(2), np.array([1.0]))
        assert made.command == pytest.approx(0.008)

    @pytest.mark.parametrize(
        "action",
        [np.zeros(2), np.zeros((1, 1)), np.array([math.nan]), [math.inf], None, "up", [None], {}],
    )
    def test_an_unusable_action_is_refused_by_name_and_changes_nothing(self, action):
        made = lift()
        with pytest.raises(ValueError, match="robot's action must"):
            made.step(np.zeros(10), action)
        with pytest.raises(ValueError, match="human's action must be 10"):
            made.step(action, NO_CHANGE)
        assert made.frame == 0
        assert made.command == 0.0


class TestEnd:
    def test_it_is_truncated_when_the_human_has_rested(self):
        made = lift()
        follow(made, made.horizon // 10)
        assert made.truncated
        assert made.dropped is None
        assert made.horizon == len(made.plan.target)

    def test_a_steep_table_slides_out_of_the_hands(self):
        made = lift()
        for _ in range(40):
            made.step(np.full(10, 0.5), np.array([-0.04]))
            if made.done:
                break
        assert "inclined" in made.dropped
        assert not made.truncated

    def test_a_hard_pull_costs_the_grip(self):
        """Two people who throw the table up and down."""
        made = lift(partner="human", subject="S3", control_period=0.02)
        for step in range(100):
            up = 0.5 if step // 5 % 2 else -0.2
            made.step(np.full(2, up), np.full(2, up))
            if made.done:
                break
        assert "N pull" in made.dropped

    def test_the_horizon_and_the_rest_before_the_lift_vary(self):
        made = lift()
        horizons, starts = set(), set()
        for seed in range(30):
            made.reset(seed)
            horizons.add(made.horizon)
            starts.add(made.plan.strokes[0][0])
        assert len(horizons) > 10
        assert len(starts) > 15


class TestReward:
    def test_is_what_the_docstring_says_and_standing_still_pays_nobody(self):
        made = parallel_env(subject="S2")
        made.reset(seed=3)
        human = made.scripted_human()
        observations, _ = made.reset(seed=3)
        returns = {"human": 0.0, "robot": 0.0}
        while made.agents:
            actions = {"human": human.act(observations["human"]), "robot": NO_CHANGE}
            observations, rewards, *_ = made.step(actions)
            world, lift = made.lift.world, made.lift
            tilt = abs(world.human_end[-1] - world.robot_end[-1])
            assert rewards["robot"] == pytest.approx(-tilt)
            miss = abs(world.human_end[-1] - lift.target[lift.frame - 1])
            assert rewards["human"] == pytest.approx(-miss - tilt)
            returns = {agent: returns[agent] + rewards[agent] for agent in returns}
        assert returns["robot"] < -1.0
        assert returns["human"] < -1.0


class TestSettings:
    @pytest.mark.parametrize(
        ("settings", "told"),
        [
            ({"behaviour": "smoth"}, "smooth"),
            ({"subject": "S9"}, "S1, S2, S3, S4, S5"),
            ({"partner": "dog"}, "'iiwa', 'nao', 'human', 'live', got 'dog'"),
            ({"latency": 0.015}, "multiple of 0.01"),
            ({"latency": -0.1}, "latency"),
            ({"control_period": 0.0}, "control_period"),
            ({"behaviour": "recorded"}, "recorded:FILE.csv"),
            ({"behaviour": "recorded:/nowhere.csv"}, "/nowhere.csv"),
        ],
    )
    def test_a_wrong_one_is_named_with_what_would_be_right(self, settings, told):
        with pytest.raises(InputError, match=told):
            parallel_env(**settings)

    def test_steps_need_a_reset_and_every_agents_action(self):
        made = parallel_env()
        with pytest.raises(RuntimeError, match="reset"):
            made.step({"human": np.zeros(10), "robot": NO_CHANGE})
        made.reset(seed=0)
        with pytest.raises(ValueError, match="missing: robot"):
            made.step({"human": np.zeros(10)})

    @pytest.mark.parametrize("period", [0.01, 0.02, 0.03, 0.05, 0.2])
    def test_every_control_period_plays_to_the_end(self, period):
        made = lift(control_period=period)
        human = made.scripted_human()
        while not made.done:
            made.step(human.act(made.human_observation()), NO_CHANGE)
        assert made.truncated


@pytest.mark.parametrize("partner", ["nao", "human", "live"])
def test_a_step_made_frame_by_frame_has_the_same_bits(partner):
    whole, parts = lift(partner=partner), lift(partner=partner)
    human = whole.scripted_human()
    for _ in range(40):
        references = human.act(whole.human_observation()).tolist()
        action = [0.008] if partner == "nao" else [0.9 * each for each in references]
        whole.carry_out(references, action)
        commands = parts.commands(action)
        for reference, command in zip(references, commands, strict=True):
            parts.move([reference], [command])
        parts.end(commands[-1])
        assert parts.world.state() == whole.world.state()
    assert since_reset(parts.world.robot_force).tolist() == (
        since_reset(whole.world.robot_force).tolist()
    )
    assert (parts.frame, parts.command, parts.dropped) == (400, whole.command, None)
