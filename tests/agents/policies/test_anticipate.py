import dataclasses
import json

import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.control.anticipation import (
    ARM_LAG,
    MODES,
    Anticipation,
    FeatureWindow,
    anticipation_json,
    load_anticipation,
    read_anticipation,
)
from colift.agents.estimators.perceptron import Perceptron
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.anticipate import (
    Anticipate,
    AnticipateParameters,
    AnticipationController,
)
from colift.base.errors import InputError
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import SECOND_PERSON_SPEC
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite

LEADS = np.arange(10) * 0.05
LATENCY = 0.1


def steady(interval=0.1):
    """Return an anticipation that the last velocity stays: rise = v (latency + lead)."""
    window = FeatureWindow(interval=interval, velocities=2)
    outputs = len(LEADS) + len(MODES) + 1
    weights = np.zeros((window.size, outputs))
    weights[1, : len(LEADS)] = (LATENCY + LEADS) / interval
    biases = np.zeros(outputs)
    biases[len(LEADS) : -1] = -0.5, 0.0, 0.9, 0.3, 0.0
    return Anticipation(
        perceptron=Perceptron(
            centre=np.zeros(window.size),
            deviation=np.ones(window.size),
            weights=(weights,),
            biases=(biases,),
            gain=np.ones(outputs),
        ),
        window=window,
        leads=LEADS,
        latency=LATENCY,
    )


def follow(path, *, period=0.1, steps=40, sag=0.0, **parameters):
    """Let a controller see a path late; its hand is behind the command by the arm's lag and a sag.

    Returns
    -------
    Command at the end of each step, and internals.
    """
    controller = AnticipationController(steady(period), AnticipateParameters(**parameters))
    controller.reset(0)
    commands, told = [0.0], []
    for k in range(steps):
        time = period * k
        times = period * np.arange(len(commands))
        hand = np.interp(time - ARM_LAG, times, commands) - sag
        view = np.array([path(time - LATENCY), 0.3, hand, commands[-1], time])
        commands.append(commands[-1] + float(controller.act(view)[0]))
        told.append(controller.internals())
    return np.array(commands[1:]), told


@pytest.mark.parametrize("period", [0.02, 0.05, 0.1])
@pytest.mark.parametrize("smoothness", [0.0, 0.03, 1.0])
def test_a_steady_motion_is_led_by_the_arms_lag(period, smoothness):
    """Latency and period are made up for, so that the arm is where the human is."""
    steps = round(4.0 / period)
    commands, _ = follow(lambda t: 0.1 * t, period=period, steps=steps, smoothness=smoothness)
    ends = period * np.arange(1, steps + 1)
    settled = steps // 2
    assert commands[settled:] == pytest.approx(0.1 * (ends[settled:] + ARM_LAG), abs=1e-5)


def test_an_arm_that_is_taken_for_quick_is_not_led():
    commands, _ = follow(lambda t: 0.1 * t, arm_lag=0.0)
    assert commands[-1] == pytest.approx(0.1 * 4.0, abs=1e-6)


def test_the_sag_is_made_up_for_in_its_time():
    commands, told = follow(lambda t: 0.05, sag=0.002)
    assert commands[-1] == pytest.approx(0.052, abs=1e-6)
    # A share 1 - exp(-period / memory) of what is measured first.
    assert told[0]["sag"] == pytest.approx(0.002 * -np.expm1(-1.0), rel=1e-6)
    forgetful, _ = follow(lambda t: 0.05, sag=0.002, sag_memory=1e9)
    assert forgetful[-1] == pytest.approx(0.05, abs=1e-6)


def test_a_dearer_bend_starts_more_softly():
    def onset(t):
        return 0.1 * max(t - 1.0, 0.0)

    def roughest(smoothness):
        commands, _ = follow(onset, smoothness=smoothness)
        return np.abs(np.diff(commands, 2)).max()

    assert roughest(1.0) < 0.8 * roughest(0.03) < 0.8 * roughest(0.0)


def test_it_tells_what_it_foresees():
    _, told = follow(lambda t: 0.1 * t)
    last = told[-1]  # decided at 3.9 s
    assert last["prediction"] == pytest.approx(0.4, abs=1e-6)
    assert last["predicted_velocity"] == pytest.approx(0.1, abs=1e-6)
    assert last["predicted_end"] == pytest.approx(0.38, abs=1e-6)
    assert [last[name] for name in MODES] == pytest.approx([0, 0, 0.75, 0.25, 0], abs=1e-5)


def test_role_and_confidence_follow_the_foresight():
    _, told = follow(lambda t: 0.1 * t)
    assert told[-1]["confidence"] > 0.99
    _, still = follow(lambda t: 0.05)
    assert still[-1]["role"] == 0.0
    assert still[0]["role"] < 0.5
    _, surprised = follow(lambda t: 0.1 * min(t, 4.0), steps=60)
    # The stop at 4.0 s is seen at 4.2 s: what was foreseen for 4.1 s was 10 mm too high.
    before, after = surprised[41]["confidence"], surprised[42]["confidence"]
    assert before > 0.99
    mean_square = -np.expm1(-0.1 / 0.5) * 0.01**2
    assert after == pytest.approx(0.005**2 / (0.005**2 + mean_square), abs=0.02)


def test_an_episode_begins_without_memory_of_the_last():
    policy = Anticipate()
    rng = np.random.default_rng(0)
    views = 0.1 * rng.random((20, 5))
    views[:, RobotObservation.TIME] = 0.1 * np.arange(20)

    def play():
        policy.reset(0)
        return [(float(policy.act(view)[0]), policy.internals()) for view in views]

    assert play() == play()


def test_it_sees_no_more_than_four_of_its_observations():
    """Where the robot's end was is not looked at: the hand tells it better."""
    policy = Anticipate()
    actions = []
    for end in (0.0, 0.2):
        policy.reset(0)
        actions.append(policy.act(np.array([0.05, end, 0.04, 0.04, 0.0])))
    assert actions[0] == actions[1]


def held_out(behaviours, seeds):
    return Suite(
        name="held out",
        scenarios=tuple(make_scenario(behaviour, "draw-200000") for behaviour in behaviours),
        seeds=seeds,
    )


def rmse(run):
    return np.array([episode.scores["rmse_mm"] for episode in run.episodes])


def test_with_a_person_it_never_met_it_beats_the_human_partner_and_blend():
    suite = held_out(("smooth", "pause", "changing_goal"), (200_000, 200_001, 200_002))
    mine = run_suite(PolicySpec(text="anticipate"), suite)
    assert not any(episode.failure for episode in mine.episodes)
    human_human = run_suite(SECOND_PERSON_SPEC, suite.with_partner("human"))
    blend = run_suite(PolicySpec(text="blend"), suite)
    assert rmse(mine).mean() < 0.7 * rmse(human_human).mean()
    assert (rmse(mine) < 0.5 * rmse(blend)).all()
    mine_smooth = [episode.scores["sparc"] for episode in mine.episodes]
    blend_smooth = [episode.scores["sparc"] for episode in blend.episodes]
    assert np.mean(mine_smooth) > np.mean(blend_smooth)


def test_it_finds_pauses_and_rests_in_the_trace():
    """At the human's real stops and rests it holds them for more likely than anything else."""
    suite = held_out(("pause",), (200_000, 200_001, 200_002))
    told = {"pause": [], "rest": []}
    for episode in run_suite(PolicySpec(text="anticipate"), suite).episodes:
        speed = np.abs(np.gradient(episode.trace.human_end, 0.01))
        for k in range(5, len(episode.trace.action) - 5):
            now, then = speed[10 * k], speed[10 * k + 30]
            for name, found in (
                ("pause", now > 0.04 and then < 0.01),
                ("rest", speed[10 * k - 30 : 10 * k + 30].max() < 0.01),
            ):
                if found:
                    told[name].append([episode.trace.internals[mode][k] for mode in MODES])
    for name, probabilities in told.items():
        means = np.mean(probabilities, axis=0)
        assert MODES[means.argmax()] == name
        assert means.max() > 2 * np.sort(means)[-2]


@pytest.mark.parametrize(
    "wrong",
    [{"smoothness": -1.0}, {"arm_lag": np.inf}, {"horizon": 0.0}, {"sag_memory": np.nan}],
)
def test_parameters_out_of_range_are_refused(wrong):
    with pytest.raises(InputError, match=next(iter(wrong))):
        AnticipateParameters(**wrong)


def test_a_model_is_read_as_it_was_written(tmp_path):
    model = dataclasses.replace(steady(), provenance={"seeds": [1, 2]})
    again = read_anticipation(anticipation_json(model))
    inputs = np.arange(3) / 100
    assert again.perceptron(inputs) == pytest.approx(model.perceptron(inputs), rel=1e-4)
    assert (again.window, again.latency, again.provenance) == (
        model.window,
        model.latency,
        model.provenance,
    )
    path = tmp_path / "model.json"
    path.write_text(anticipation_json(model))
    Anticipate(parameters=AnticipateParameters(model=str(path)))


def test_files_that_are_no_model_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"missing\.json: cannot be read"):
        load_anticipation(str(tmp_path / "missing.json"))
    content = json.loads(anticipation_json(steady()))
    for name, value, told in (
        ("leads_s", [0.0, 0.1], "and 8 outputs"),
        ("leads_s", [0.0] * 10, "leads must increase"),
        ("window", {"velocities": 3}, "a perceptron of 4 inputs"),
        ("window", {"velocities": 2, "sags": 1}, "not an anticipation: TypeError"),
        ("perceptron", {}, "not an anticipation: KeyError"),
    ):
        path = tmp_path / "wrong.json"
        path.write_text(json.dumps({**content, name: value}))
        load_anticipation.cache_clear()
        with pytest.raises(InputError, match=told):
            load_anticipation(str(path))


def test_what_is_shipped_is_small_and_was_learned_apart_from_the_suites():
    model = load_anticipation()
    assert len(anticipation_json(model)) < 120_000
    first, last = model.provenance["seeds"]
    assert 100_000 <= first <= last < 150_000
