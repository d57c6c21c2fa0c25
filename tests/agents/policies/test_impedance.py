from dataclasses import replace

import numpy as np
import pytest
from colift.agents.policies.copy import Copy
from colift.agents.policies.hold import Hold
from colift.agents.policies.impedance import (
    IMPEDANCE_PARAMETERS,
    Impedance,
    ImpedanceParameters,
    advance,
    damping_at,
)
from colift.agents.policies.proportional import Proportional
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from scipy.linalg import expm

PARAMETERS = ImpedanceParameters(mass=1.3, stiffness=50.0)
CRITICAL = 2 * np.sqrt(1.3 * 50.0)
DAMPINGS = [0.0, 0.4, CRITICAL, 3 * CRITICAL, 400.0]
PERIODS = [1e-4, 0.02, 0.05, 0.1, 0.5]


def follow(heights, period, parameters=None):
    """Return the commands [m] of a hand that does as told, and the internals, step by step."""
    policy = Impedance(parameters=parameters)
    policy.reset(0)
    commands, internals = [0.0], []
    for k, height in enumerate(heights):
        view = np.array([height, 0.3, -0.3, commands[-1], period * k])
        commands.append(commands[-1] + policy.act(view)[0])
        internals.append(policy.internals())
    return np.array(commands), internals


def constant(damping):
    return replace(PARAMETERS, still_damping=damping, moving_damping=damping)


def energy(offset, velocity):
    return (PARAMETERS.mass * velocity**2 + PARAMETERS.stiffness * offset**2) / 2


class TestDamping:
    def test_is_that_of_stillness_and_of_movement_at_its_limits(self):
        assert damping_at(0.0, PARAMETERS) == PARAMETERS.still_damping
        assert damping_at(1.0, PARAMETERS) == pytest.approx(PARAMETERS.moving_damping, rel=1e-12)

    def test_falls_by_one_less_1_over_e_at_the_speed_scale(self):
        low, high = PARAMETERS.moving_damping, PARAMETERS.still_damping
        share = (damping_at(PARAMETERS.speed_scale, PARAMETERS) - low) / (high - low)
        assert share == pytest.approx(np.exp(-1.0), rel=1e-12)

    def test_falls_with_speed_in_either_direction(self):
        speeds = np.linspace(0.0, 4 * PARAMETERS.speed_scale, 40)
        dampings = [damping_at(speed, PARAMETERS) for speed in speeds]
        assert (np.diff(dampings) < 0.0).all()
        assert [damping_at(-speed, PARAMETERS) for speed in speeds] == dampings

    def test_is_critical_while_the_human_is_still(self):
        default = IMPEDANCE_PARAMETERS
        assert default.still_damping == 2 * np.sqrt(default.mass * default.stiffness)


class TestAdvance:
    @pytest.mark.parametrize("damping", DAMPINGS)
    @pytest.mark.parametrize("period", PERIODS)
    def test_is_the_matrix_exponential(self, damping, period):
        matrix = np.array([[0.0, 1.0], [-50.0 / 1.3, -damping / 1.3]])
        exact = expm(period * matrix)
        for start in ((1.0, 0.0), (0.0, 1.0), (-0.3, 2.0)):
            then = advance(*start, damping, period, PARAMETERS)
            assert then == pytest.approx(exact @ start, rel=1e-9, abs=1e-12)

    def test_has_the_textbook_solutions(self):
        t, decay = 0.3, 0.4 / 2.6
        swing = np.sqrt(50.0 / 1.3 - decay**2)
        under = np.exp(-decay * t) * (np.cos(swing * t) + decay / swing * np.sin(swing * t))
        assert advance(1.0, 0.0, 0.4, t, PARAMETERS)[0] == pytest.approx(under, rel=1e-12)
        rate = np.sqrt(50.0 / 1.3)
        critical = (1 + rate * t) * np.exp(-rate * t)
        assert advance(1.0, 0.0, CRITICAL, t, PARAMETERS)[0] == pytest.approx(critical, rel=1e-7)

    def test_equal_roots_are_no_exception(self):
        parameters = ImpedanceParameters(mass=1.0, stiffness=64.0)
        at = advance(0.1, -0.2, 16.0, 0.1, parameters)
        assert at[0] == pytest.approx((0.1 + 0.6 * 0.1) * np.exp(-0.8), rel=1e-14)
        beside = advance(0.1, -0.2, 16.0 * (1 + 1e-12), 0.1, parameters)
        assert at == pytest.approx(beside, rel=1e-10)

    @pytest.mark.parametrize("damping", DAMPINGS)
    def test_two_half_periods_are_one(self, damping):
        half = advance(0.1, -0.3, damping, 0.05, PARAMETERS)
        whole = advance(0.1, -0.3, damping, 0.1, PARAMETERS)
        assert advance(*half, damping, 0.05, PARAMETERS) == pytest.approx(whole, rel=1e-9)

    def test_never_adds_energy(self):
        rng = np.random.default_rng(2)
        for _ in range(300):
            start = rng.normal(0.0, [0.1, 0.5])
            damping, period = np.exp(rng.uniform([-4.0, -7.0], [7.0, 0.0]))
            then = advance(*start, damping, period, PARAMETERS)
            assert energy(*then) < energy(*start)

    def test_loses_the_power_of_the_damper(self):
        lost = energy(0.1, 0.3) - energy(*advance(0.1, 0.3, 2.0, 1e-5, PARAMETERS))
        assert lost / 1e-5 == pytest.approx(2.0 * 0.3**2, rel=1e-3)

    def test_an_extreme_damping_does_not_overflow(self):
        offset, velocity = advance(0.1, 1.0, 1e7, 0.5, PARAMETERS)
        assert offset == pytest.approx(0.1, abs=1e-5)
        assert velocity == pytest.approx(0.0, abs=1e-5)


class TestFollowing:
    @pytest.mark.parametrize("damping", [1.0, CRITICAL, 50.0])
    @pytest.mark.parametrize("period", [0.02, 0.05, 0.1])
    def test_a_step_is_answered_as_by_the_equation(self, damping, period):
        # The first view is level: it only begins the clock.
        commands, _ = follow([0.0, *np.full(30, 0.1)], period, constant(damping))
        matrix = np.array([[0.0, 1.0], [-50.0 / 1.3, -damping / 1.3]])
        exact = [0.1 - 0.1 * expm(period * k * matrix)[0, 0] for k in range(31)]
        assert commands[1:] == pytest.approx(np.array(exact), abs=1e-12)

    @pytest.mark.parametrize("speed", [-0.15, 0.002, 0.02, 0.1])
    def test_a_steady_human_leads_by_damping_over_stiffness(self, speed):
        period = 0.002
        heights = speed * period * np.arange(6000)
        parameters = ImpedanceParameters(moving_damping=4.0)
        commands, _ = follow(heights, period, parameters)
        lag = damping_at(speed, parameters) / parameters.stiffness
        # A sample is held over the period: half a period of delay.
        assert (heights[-1] - commands[-2]) / speed == pytest.approx(lag + period / 2, rel=0.02)

    @pytest.mark.parametrize("period", [0.02, 0.1, 0.5])
    def test_beside_a_still_human_it_comes_to_rest_there(self, period):
        heights = np.full(400, 0.2)
        heights[:10] = 0.02 * np.arange(10)
        commands, internals = follow(heights, period)
        assert commands[-1] == pytest.approx(0.2, abs=1e-6)
        assert internals[-1]["velocity"] == pytest.approx(0.0, abs=1e-6)
        assert abs(internals[9]["velocity"]) > 0.01

    def test_is_firm_while_the_human_is_still_and_gives_way_while_the_human_moves(self):
        heights = np.concatenate((np.zeros(5), 0.01 * np.arange(1, 6), np.full(5, 0.05)))
        dampings = [told["damping"] for told in follow(heights, 0.1)[1]]
        still, moving = IMPEDANCE_PARAMETERS.still_damping, IMPEDANCE_PARAMETERS.moving_damping
        assert dampings[:5] == dampings[10:] == [still] * 5
        assert dampings[5:10] == pytest.approx([moving] * 5)

    def test_tends_to_one_motion_as_the_period_gets_short(self):
        def seen(period):
            times = period * np.arange(round(2.0 / period))
            heights = 0.1 * (1 - np.cos(np.pi * times / 2))
            return follow(heights, period, replace(PARAMETERS, speed_scale=0.1))[0][-1]

        ends = [seen(period) for period in (0.02, 0.01, 0.005, 0.0025)]
        gaps = np.abs(np.diff(ends))
        assert gaps[0] < 5e-3
        assert gaps[1:] == pytest.approx(gaps[:-1] / 2, rel=0.2)

    def test_up_and_down_are_alike(self):
        heights = np.cumsum(np.random.default_rng(3).normal(0.0, 5e-3, 60))
        commands, _ = follow(heights, 0.1)
        mirrored, _ = follow(-heights, 0.1)
        assert (mirrored == -commands).all()
        assert np.ptp(commands) > 0.01

    @pytest.mark.parametrize("scale", [0.1, 30.0])
    def test_the_unit_of_force_does_not_matter(self, scale):
        heights = np.cumsum(np.random.default_rng(3).normal(0.0, 5e-3, 60))
        scaled = replace(
            IMPEDANCE_PARAMETERS,
            mass=scale * IMPEDANCE_PARAMETERS.mass,
            stiffness=scale * IMPEDANCE_PARAMETERS.stiffness,
            still_damping=scale * IMPEDANCE_PARAMETERS.still_damping,
            moving_damping=scale * IMPEDANCE_PARAMETERS.moving_damping,
        )
        commands, _ = follow(heights, 0.1, scaled)
        assert commands == pytest.approx(follow(heights, 0.1)[0], abs=1e-8)

    def test_is_a_follower_by_command_and_not_by_the_seen_own_end(self):
        policy = Impedance()
        actions = []
        for own in (-0.1, 0.2):
            policy.reset(0)
            actions.append(policy.act(np.array([0.05, own, own, 0.02, 0.0])))
            assert policy.internals()["role"] == 0.0
        # The first step is taken to last 0.1 s, with the human still: critical, at 8 rad/s.
        assert actions[0] == actions[1] == pytest.approx(0.03 * (1 - 1.8 * np.exp(-0.8)), rel=1e-9)

    def test_reset_forgets(self):
        heights = 0.01 * np.arange(10)
        policy = Impedance()
        seconds = []
        for _ in range(2):
            policy.reset(0)
            views = [np.array([height, 0, 0, 0, 0.1 * k]) for k, height in enumerate(heights)]
            seconds.append([policy.act(view)[0] for view in views])
        assert seconds[0] == seconds[1]


class TestInTheWorld:
    def test_beats_holding_still_in_the_quick_suite(self):
        suite = make_suite("quick-v1")
        for scenario in suite.scenarios:
            lift = Lift(scenario)
            for seed in suite.seeds:
                played, held = (run_episode(lift, policy(), seed) for policy in (Impedance, Hold))
                assert played.failure is None
                assert played.scores["rmse_mm"] < 0.4 * held.scores["rmse_mm"]

    def test_is_more_level_than_a_copy_and_smoother_than_plain_feedback(self):
        rmse, sparc = {}, {}
        for policy in (Impedance, Copy, Proportional):
            scores = [
                run_episode(Lift(make_scenario(behaviour, subject)), policy(), seed).scores
                for behaviour, subject in (("smooth", "S1"), ("pause", "S3"), ("jerky", "S4"))
                for seed in (6000, 6001)
            ]
            rmse[policy] = np.mean([score["rmse_mm"] for score in scores])
            sparc[policy] = np.mean([score["sparc"] for score in scores])
        assert rmse[Impedance] < 0.95 * rmse[Copy]
        assert sparc[Impedance] > sparc[Proportional] + 0.05

    @pytest.mark.parametrize(
        ("control_period", "latency"), [(0.02, 0.1), (0.05, 0.0), (0.1, 0.2), (0.02, 0.02)]
    )
    def test_follows_at_any_period_and_latency(self, control_period, latency):
        scenario = make_scenario("pause", "S2", control_period=control_period, latency=latency)
        episode = run_episode(Lift(scenario), Impedance(), 5000)
        assert episode.failure is None
        assert episode.scores["rmse_mm"] < 35.0
        apart = episode.trace.human_end - episode.trace.robot_end
        assert np.abs(apart[-10:]).max() < 5e-3


@pytest.mark.parametrize(
    "name", ["mass", "stiffness", "still_damping", "moving_damping", "speed_scale"]
)
@pytest.mark.parametrize("value", [0.0, -1.0, np.inf, np.nan])
def test_an_impossible_parameter_is_refused(name, value):
    with pytest.raises(InputError, match=f"{name} must be a positive number, got {value}"):
        ImpedanceParameters(**{name: value})
