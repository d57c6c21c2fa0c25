import dataclasses

import numpy as np
import pytest
from colift.agents.agent import FRAME, HISTORY, Agent, HumanObservation
from colift.agents.humans import SUBJECTS, ScriptedHuman, Smooth

S1, S3 = SUBJECTS["S1"], SUBJECTS["S3"]
STILL = dataclasses.replace(S1, motor_noise=0.0, tremor_amplitude=0.0)


def carry_out(subject, target, seed=0, body=lambda reference: reference, frames=10):
    """Return the hand's reference while ``body`` turns the reference into the own height."""
    human = ScriptedHuman(subject=subject)
    human.reset(seed)
    hand = np.zeros(0)
    for start in range(0, len(target), frames):
        own = np.concatenate((np.zeros(HISTORY), body(hand)))[-HISTORY:]
        observation = np.full(HumanObservation.size(frames), 1e9)
        observation[HumanObservation.OWN_HEIGHT] = own
        observation[HumanObservation.TARGET] = target[start : start + frames]
        hand = np.concatenate((hand, human.act(observation)))
    return hand


def target_of(subject, seed=0):
    return Smooth().plan(subject, seed).target


def test_it_is_an_agent():
    assert isinstance(ScriptedHuman(subject=S1), Agent)


@pytest.mark.parametrize("frames", [2, 10, 20])
def test_a_steady_hand_on_a_perfect_arm_follows_the_plan(frames):
    target = np.resize(target_of(STILL), 600)
    target[-200:] = 0.0
    assert carry_out(STILL, target, frames=frames) == pytest.approx(target, abs=1e-12)


def test_reference_has_a_value_for_each_frame_in_float64():
    human = ScriptedHuman(subject=S3)
    human.reset(1)
    action = human.act(np.zeros(HumanObservation.size(20)))
    assert action.shape == (20,)
    assert action.dtype == np.float64


def test_same_seed_same_hand_other_seed_other_hand():
    target = target_of(S3)
    first = carry_out(S3, target, seed=4)
    assert np.array_equal(first, carry_out(S3, target, seed=4))
    assert np.abs(first - carry_out(S3, target, seed=5)).max() > 1e-4


def test_reset_forgets_the_episode_before():
    target = target_of(S3)
    human = ScriptedHuman(subject=S3)
    observation = np.zeros(HumanObservation.size(10))
    observation[HumanObservation.TARGET] = target[150:160]
    human.reset(3)
    first = human.act(observation)
    for _ in range(7):
        human.act(observation)
    human.reset(3)
    assert np.array_equal(human.act(observation), first)


def test_motor_noise_grows_with_the_subjects_k_and_with_speed():
    def noise(k, speed):
        subject = dataclasses.replace(STILL, motor_noise=k)
        target = speed * FRAME * np.arange(1, 1001)
        hands = [carry_out(subject, target, seed) - target for seed in range(20)]
        return np.std(np.diff(hands, axis=1) / FRAME)

    base = noise(0.03, 0.1)
    assert base == pytest.approx(0.03 * 0.1, rel=0.1)
    assert noise(0.06, 0.1) == pytest.approx(2.0 * base, rel=1e-6)
    assert noise(0.03, 0.2) == pytest.approx(2.0 * base, rel=1e-6)


def test_a_hand_at_rest_has_tremor_only():
    hand = carry_out(S3, np.zeros(200))
    assert np.abs(hand).max() <= S3.tremor_amplitude * 1.2
    frequency = np.fft.rfftfreq(200, FRAME)
    assert frequency[np.argmax(np.abs(np.fft.rfft(hand)))] == pytest.approx(7.0, abs=0.5)


def test_position_errors_leak_away():
    noisy = dataclasses.replace(STILL, motor_noise=0.1)
    target = np.minimum(0.2 * FRAME * np.arange(1, 601), 0.2)
    error = np.array(
        [
            carry_out(noisy, target, seed, body=lambda hand: target[: len(hand)]) - target
            for seed in range(10)
        ]
    )
    assert np.std(error[:, 99]) > 5e-4
    assert error[:, 240] == pytest.approx(error[:, 99] * np.exp(-1.41 / 0.7), rel=1e-6)


def test_noise_is_the_same_whatever_is_observed():
    target = target_of(S3)
    steady = dataclasses.replace(S3, motor_noise=0.0, tremor_amplitude=0.0)
    noise = []
    for gain in (1.0, 0.6):
        own = gain * target

        def body(hand, own=own):
            return own[: len(hand)]

        noise.append(carry_out(S3, target, 2, body) - carry_out(steady, target, 2, body))
    assert np.abs(noise[0]).max() > 1e-3
    assert noise[0] == pytest.approx(noise[1], abs=1e-12)


def test_noise_does_not_run_out_in_a_long_episode():
    hand = carry_out(S3, 0.1 * FRAME * np.arange(1, 2501))
    velocity = np.diff(hand) / FRAME
    for part in np.split(velocity[:2400], 4):
        assert np.std(part) > 1e-3
    assert np.abs(np.diff(velocity)).max() < 0.05


def test_hand_comes_to_the_intended_height_against_a_holding_partner():
    target = np.concatenate((target_of(STILL)[:350], np.full(650, 0.2)))
    target[:350] = np.minimum(target[:350], 0.2)

    def held_back(hand):
        return 0.9 * hand

    first = carry_out(STILL, target, body=held_back)
    assert held_back(first)[-1] == pytest.approx(0.2, abs=2e-3)


def test_correction_is_limited():
    target = np.full(1500, 0.2)
    hand = carry_out(STILL, target, body=np.zeros_like)
    assert hand[-1] == pytest.approx(0.23, abs=1e-9)
    assert np.abs(np.diff(hand)).max() < 0.2 * 0.011


@pytest.mark.parametrize("delay", [0.11, 0.14, 0.18])
def test_correction_sets_in_one_visual_delay_after_the_error(delay):
    subject = dataclasses.replace(STILL, visual_delay=delay)
    pushed_at = 95

    def pushed(hand):
        height = np.zeros(len(hand))
        height[pushed_at:] = -0.05
        return height

    hand = carry_out(subject, np.zeros(200), body=pushed)
    onset = np.flatnonzero(hand)[0] - pushed_at
    assert delay <= onset * FRAME <= delay + 0.11


def test_observation_is_left_as_it_was():
    human = ScriptedHuman(subject=S3)
    human.reset(0)
    observation = np.linspace(0.0, 0.1, HumanObservation.size(10))
    before = observation.copy()
    human.act(observation)
    assert np.array_equal(observation, before)
