import math

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.episode.metrics import (
    FAILED_FRAME_MM,
    abs_error_mm,
    human_force_n,
    human_work_j,
    max_tilt_deg,
    rest_speed_mm_s,
    rmse_about_mean_mm,
    rmse_mm,
    robot_lag_ms,
    stroke_smoothness,
)
from colift.benchmark.episode.smoothness import dimensionless_jerk, ldlj, sparc
from numpy.typing import NDArray

Trace = NDArray[np.float64]
T = np.arange(800) / 100


def move(start: float, duration: float = 2.0, height: float = 0.2) -> Trace:
    """Rise by ``height`` along a minimum-jerk path that begins at ``start`` [s]."""
    s = np.clip((T - start) / duration, 0, 1)
    return height * (10 * s**3 - 15 * s**4 + 6 * s**5)


def lift_and_lower(delay: float = 0.0) -> Trace:
    return move(1.0 + delay) - move(4.5 + delay)


STROKES = [(100, 300), (450, 650)]


class TestErrors:
    def test_rmse_of_a_constant_offset_is_the_offset_in_millimetres(self) -> None:
        assert rmse_mm(lift_and_lower(), lift_and_lower() + 0.012) == pytest.approx(12.0)

    def test_rmse_weighs_squares_over_all_frames(self) -> None:
        assert rmse_mm([0.0, 0.003, 0.0, 0.0], [0.0, 0.0, 0.004, 0.0]) == pytest.approx(2.5)

    def test_absolute_error_sums_over_frames_without_cancelling(self) -> None:
        assert abs_error_mm([0.010, 0.0, 0.020], [0.0, 0.010, 0.015]) == pytest.approx(25.0)

    def test_about_the_mean_a_constant_tilt_is_no_error(self) -> None:
        level = lift_and_lower()
        assert rmse_about_mean_mm(level, level + 0.012) == pytest.approx(0.0, abs=1e-9)
        assert rmse_about_mean_mm(np.zeros(2), np.array([0.002, 0.006])) == pytest.approx(2.0)
        tilted = lift_and_lower(0.2) + 0.005
        mean = 1000 * float(np.mean(level - tilted))
        whole = math.hypot(rmse_about_mean_mm(level, tilted), mean)
        assert whole == pytest.approx(rmse_mm(level, tilted))
        assert rmse_about_mean_mm(np.zeros(3), np.ones(3), horizon=4) == pytest.approx(125.0)

    def test_frames_cut_off_by_a_failure_count_250_mm(self) -> None:
        assert FAILED_FRAME_MM == 250.0
        assert rmse_mm(np.zeros(3), np.zeros(3), horizon=4) == pytest.approx(125.0)
        assert abs_error_mm([0.01] * 3, np.zeros(3), horizon=5) == pytest.approx(530.0)

    def test_a_horizon_that_was_reached_changes_nothing(self) -> None:
        human, robot = lift_and_lower(), lift_and_lower(0.2)
        assert rmse_mm(human, robot, horizon=800) == rmse_mm(human, robot)
        assert abs_error_mm(human, robot, horizon=800) == abs_error_mm(human, robot)

    def test_failing_earlier_is_never_better(self) -> None:
        human, robot = lift_and_lower(), np.zeros(800)
        errors = [rmse_mm(human[:n], robot[:n], horizon=800) for n in (800, 500, 200, 1)]
        assert errors == sorted(errors)

    @pytest.mark.parametrize("metric", [rmse_mm, abs_error_mm])
    def test_rejects_traces_that_do_not_match(self, metric) -> None:
        with pytest.raises(InputError, match="human_end has 3 frames, robot_end 4"):
            metric(np.zeros(3), np.zeros(4))
        with pytest.raises(InputError, match="horizon is 2"):
            metric(np.zeros(3), np.zeros(3), horizon=2)
        with pytest.raises(InputError, match="robot_end at frame 1"):
            metric(np.zeros(2), [0.0, math.nan])
        with pytest.raises(InputError, match=r"shape \(0,\)"):
            metric([], [])


class TestTilt:
    def test_is_the_angle_of_the_steepest_frame_whichever_end_is_up(self) -> None:
        assert max_tilt_deg([0.0, 0.1, 0.0], [0.0, 0.0, 0.4], length=0.8) == pytest.approx(30.0)

    def test_of_a_level_table_is_zero(self) -> None:
        assert max_tilt_deg(lift_and_lower(), lift_and_lower(), length=0.8) == 0.0

    @pytest.mark.parametrize("length", [0.3, 0.0, -1.0])
    def test_rejects_a_table_shorter_than_the_difference(self, length: float) -> None:
        with pytest.raises(InputError, match=r"length is .* 0\.400 m"):
            max_tilt_deg([0.4], [0.0], length=length)


def smoothness(z: Trace, strokes, *, metric, human: Trace | None = None) -> float:
    """Score an end that moves as the human does, if no other human is given."""
    return stroke_smoothness(z, z if human is None else human, strokes, metric=metric)


class TestStrokeSmoothness:
    def test_is_the_mean_over_strokes_of_the_metric_of_speed(self) -> None:
        z = move(1.0) - move(4.5, duration=1.5)
        up = sparc(np.abs(np.gradient(z, 0.01))[100:330])
        down = sparc(np.abs(np.gradient(z, 0.01))[450:630])
        score = smoothness(z, [(100, 300), (450, 600)], metric=sparc)
        assert score == pytest.approx((up + down) / 2)
        assert up != down

    def test_sees_speeds_in_metres_per_second(self) -> None:
        peak = smoothness(lift_and_lower(), STROKES, metric=lambda speed: float(speed.max()))
        assert peak == pytest.approx(0.2 * 1.875 / 2, rel=1e-3)

    def test_windows_have_a_tail_of_300_ms_cut_at_the_next_stroke_and_at_the_end(self) -> None:
        seen: list[int] = []

        def record(speed: Trace) -> float:
            seen.append(speed.size)
            return 0.0

        smoothness(T / 10, [(0, 100), (200, 300), (310, 400), (600, 780)], metric=record)
        assert seen == [130, 110, 120, 200]

    def test_a_lag_within_the_tail_costs_nothing(self) -> None:
        level = smoothness(lift_and_lower(), STROKES, metric=sparc)
        late = smoothness(lift_and_lower(0.25), STROKES, metric=sparc)
        assert late == pytest.approx(level, rel=0.01)

    @pytest.mark.parametrize("metric", [sparc, dimensionless_jerk, ldlj])
    def test_a_staircase_is_rougher_than_the_smooth_lift(self, metric) -> None:
        smooth = lift_and_lower()
        steps = 0.02 * np.round(np.repeat(smooth[::10], 10) / 0.02)
        rough = smoothness(steps, STROKES, metric=metric)
        assert rough < smoothness(smooth, STROKES, metric=metric)

    @pytest.mark.parametrize("metric", [sparc, dimensionless_jerk, ldlj])
    def test_holding_still_earns_none(self, metric) -> None:
        assert math.isnan(smoothness(np.zeros(800), STROKES, metric=metric))

    def test_holding_still_in_one_stroke_spoils_the_episode(self) -> None:
        assert math.isnan(smoothness(move(1.0), STROKES, metric=sparc))

    @pytest.mark.parametrize(("height", "scored"), [(0.0049, False), (0.0051, True)])
    def test_moving_begins_at_5_mm(self, height: float, scored: bool) -> None:
        score = smoothness(move(1.0, height=height), [(100, 300)], metric=sparc)
        assert math.isfinite(score) == scored

    @pytest.mark.parametrize(("share", "scored"), [(0.24, False), (0.26, True)])
    def test_creeping_earns_none(self, share: float, scored: bool) -> None:
        human = lift_and_lower()
        score = smoothness(share * human, STROKES, metric=sparc, human=human)
        assert math.isfinite(score) == scored

    def test_a_lift_that_failed_before_its_last_stroke_ended_has_none(self) -> None:
        assert math.isnan(smoothness(lift_and_lower()[:600], STROKES, metric=sparc))
        assert math.isfinite(smoothness(lift_and_lower()[:650], STROKES, metric=sparc))

    def test_an_episode_without_strokes_has_none(self) -> None:
        assert math.isnan(smoothness(lift_and_lower(), [], metric=sparc))

    @pytest.mark.parametrize(
        "strokes", [[(100, 100)], [(-5, 100)], [(100, 300), (250, 400)], [(450, 650), (100, 300)]]
    )
    def test_rejects_strokes_out_of_order(self, strokes: list[tuple[int, int]]) -> None:
        with pytest.raises(InputError, match="must start at frame"):
            smoothness(lift_and_lower(), strokes, metric=sparc)


class TestHumanEffort:
    def test_force_is_the_root_mean_square(self) -> None:
        assert human_force_n([3.0, -4.0, 0.0, 0.0]) == pytest.approx(2.5)

    def test_work_of_a_constant_force_is_force_times_distance(self) -> None:
        assert human_work_j(np.full(101, 2.0), np.full(101, 0.5)) == pytest.approx(1.0)

    def test_lifting_and_lowering_both_cost_work(self) -> None:
        velocity = np.gradient(lift_and_lower(), 0.01)
        assert human_work_j(np.full(800, 3.0), velocity) == pytest.approx(2 * 3.0 * 0.2, rel=1e-3)

    def test_holding_a_load_still_is_force_without_work(self) -> None:
        assert human_work_j(np.full(50, 9.0), np.zeros(50)) == 0.0


class TestLag:
    @pytest.mark.parametrize("delay_ms", [-250.0, -13.0, 0.0, 4.0, 100.0, 237.5, 800.0])
    def test_recovers_a_pure_delay_to_a_tenth_of_a_frame(self, delay_ms: float) -> None:
        lag = robot_lag_ms(lift_and_lower(), lift_and_lower(delay_ms / 1000))
        assert lag == pytest.approx(delay_ms, abs=1.0)

    def test_does_not_depend_on_how_far_the_robot_goes(self) -> None:
        lag = robot_lag_ms(lift_and_lower(), 0.3 * lift_and_lower(0.15) + 0.02)
        assert lag == pytest.approx(150.0, abs=1.0)

    def test_survives_the_noise_of_motion_capture(self) -> None:
        noise = np.random.default_rng(0).normal(0.0, 0.00023, size=(2, 800))
        lag = robot_lag_ms(lift_and_lower() + noise[0], lift_and_lower(0.15) + noise[1])
        assert lag == pytest.approx(150.0, abs=20.0)

    def test_a_copy_in_steps_of_100_ms_lags_by_its_latency_and_half_a_step(self) -> None:
        held = np.repeat(lift_and_lower(0.1)[::10], 10)
        assert robot_lag_ms(lift_and_lower(), held) == pytest.approx(145.0, abs=10.0)

    def test_is_none_if_either_end_holds_still(self) -> None:
        assert math.isnan(robot_lag_ms(lift_and_lower(), np.full(800, 0.1)))
        assert math.isnan(robot_lag_ms(0.01 * lift_and_lower(), lift_and_lower()))

    def test_is_none_if_the_robot_only_ever_goes_the_other_way(self) -> None:
        assert math.isnan(robot_lag_ms(move(1.0), -move(1.0)))

    def test_beyond_the_range_it_is_the_end_of_the_range(self) -> None:
        assert robot_lag_ms(move(1.0), move(2.5)) == 1000.0
        assert robot_lag_ms(move(1.5), move(0.5)) == -300.0


class TestTrembling:
    def test_it_is_the_speed_of_a_sine_at_rest_whatever_the_strokes(self) -> None:
        sine = 0.002 * np.sin(2 * np.pi * 2 * T)
        found = rest_speed_mm_s(lift_and_lower() + sine, STROKES)
        assert found == pytest.approx(2 * 2 * np.pi * 2 / np.sqrt(2), rel=0.03)
        assert rest_speed_mm_s(lift_and_lower(), STROKES) == pytest.approx(0.0, abs=1e-9)

    def test_a_late_end_has_half_a_second(self) -> None:
        assert rest_speed_mm_s(lift_and_lower(0.45), STROKES) == pytest.approx(0.0, abs=0.01)
        assert rest_speed_mm_s(lift_and_lower(0.9), STROKES) > 10.0

    def test_without_a_rest_there_is_none(self) -> None:
        assert math.isnan(rest_speed_mm_s(lift_and_lower(), [(0, 800)]))

    def test_one_frame_has_no_speed(self) -> None:
        with pytest.raises(InputError, match="height has 1 frame"):
            rest_speed_mm_s(T[:1], STROKES)
