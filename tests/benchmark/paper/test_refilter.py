"""The predictor, offline, against what it said online."""

import dataclasses

import numpy as np
import pytest
from colift.agents.control.predictor import PredictorParameters
from colift.agents.policies.blend import Blend
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.paper.evidence import blend_parameters
from colift.benchmark.paper.refilter import confidence_trajectory, refilter
from colift.benchmark.paper.topics.timing import ahead_errors, retuned
from colift.benchmark.paper.watched import sampled_lifts, watched_blend


def test_a_watched_blend_acts_as_the_blend(made, suite):
    lift = Lift(suite.scenarios[0])
    plain = run_episode(lift, Blend(), 1000)
    lift.close()
    watched = made.evidence.blend.episodes[0]
    assert np.array_equal(plain.trace.action, watched.trace.action)
    assert np.array_equal(plain.trace.robot_end, watched.trace.robot_end)


def test_offline_equals_online(made):
    for lift in made.evidence.lifts:
        refiltered = lift.refiltered
        confidence = confidence_trajectory(refiltered.likelihood, 0.45)
        assert confidence == pytest.approx(lift.confidence, abs=1e-9)
        assert refiltered.height[1:] == pytest.approx(lift.predicted[1:], abs=1e-12)


def test_samples_are_the_traces_at_their_frames_but_for_the_sensor(made):
    for lift in made.evidence.lifts:
        frames = lift.sample_frames
        shown = frames >= 0
        difference = lift.samples[shown] - lift.episode.trace.human_end[frames[shown]]
        assert 1e-5 < np.abs(difference).max() < 0.0015


def test_a_step_shows_an_event_as_soon_as_its_sample_is_late_enough(made):
    lift = made.evidence.pauses[0]
    for name in ("brake", "pause", "resume"):
        step, frame = lift.step_showing(lift.event(name)), lift.event(name)
        assert lift.sample_frames[step] >= frame > lift.sample_frames[step - 1]


def test_at_the_papers_period_the_horizon_is_one_step(made):
    lift = made.evidence.lifts[0]
    assert ahead_errors(lift)[1:] == pytest.approx(lift.errors[1:], abs=1e-12)


def test_retuning_changes_nothing_at_the_papers_period_and_doubles_at_half_of_it(made):
    lift = made.evidence.lifts[0]
    half = dataclasses.replace(lift.scenario, control_period=0.05)
    assert retuned(lift) == lift.parameters
    noise = retuned(dataclasses.replace(lift, scenario=half)).motion.process_noise
    assert noise == pytest.approx(2 * lift.parameters.motion.process_noise)


def test_other_parameters_of_the_blend_are_those_of_all_its_lifts(suite):
    parameters = blend_parameters("forgetting=0.95,motion.process_noise=1e5")
    short = dataclasses.replace(suite, scenarios=suite.scenarios[:1], seeds=(1000,))
    run = run_suite(watched_blend(parameters), short)
    (lift,) = sampled_lifts(run, parameters)
    profile = confidence_trajectory(lift.refiltered.likelihood, 0.95)
    assert profile == pytest.approx(lift.confidence, abs=1e-9)
    assert lift.confidence.min() > 0.3
    assert retuned(lift) == parameters


def test_a_parameter_that_the_blend_has_not_is_refused_by_name():
    with pytest.raises(InputError, match="no parameter 'forgeting'; did you mean forgetting"):
        blend_parameters("forgeting=0.95")


def test_a_constant_velocity_is_predicted_without_error_in_the_end():
    refiltered = refilter(0.02 * np.arange(60), 0.1, PredictorParameters())
    assert refiltered.height[-1] == pytest.approx(0.02 * 59, abs=1e-6)
    assert refiltered.velocity[-1] == pytest.approx(0.2, abs=1e-5)
    assert refiltered.likelihood[-1] == pytest.approx(1.0)
