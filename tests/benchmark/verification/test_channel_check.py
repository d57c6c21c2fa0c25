"""Bundles of policies behind a channel: verified as they are, and refused if the channel is not."""

import dataclasses
import json
import math
import shutil

import jsonschema
import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import read_bundle, results, write_bundle
from colift.benchmark.bundle.schema import results_schema
from colift.benchmark.channels import CHANNELS, Channel, Link
from colift.benchmark.channels.recorded import recorded
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.verification import verify

from .forging import SUITE, edit_arrays, edit_json, mend, refused

ONE = dataclasses.replace(SUITE, scenarios=SUITE.scenarios[:1])
HOME = CHANNELS["home"]


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """Return the bundle of a run over the channel home."""
    folder = tmp_path_factory.mktemp("channels") / "home"
    run = run_suite(PolicySpec(text="copy"), ONE, channel=HOME)
    write_bundle(folder, run, results(run, {}).plain())
    return folder


@pytest.fixture
def forged(home, tmp_path):
    return shutil.copytree(home, tmp_path / "forged")


def claim(folder, channel):
    """Claim another channel, in both files that have it."""
    plain = recorded(channel)
    edit_json(folder, "manifest.json", lambda content: content["recipe"].update(channel=plain))
    edit_json(folder, "results.json", lambda content: content.update(channel=plain))
    mend(folder)


def test_a_bundle_with_a_channel_is_verified_and_names_it(home):
    verdict = verify(home)
    assert verdict.ok
    assert verdict.bit_equal
    assert verdict.suite.endswith(", over the channel home")
    assert read_bundle(home).recipe.channel == HOME
    content = json.loads((home / "results.json").read_text())
    assert content["channel"] == recorded(HOME)
    jsonschema.validate(content, results_schema())
    content["channel"]["up"].pop("loss")
    with pytest.raises(jsonschema.ValidationError, match="'loss' is a required property"):
        jsonschema.validate(content, results_schema())


def test_a_channel_of_its_own_is_described(forged, tmp_path):
    run = run_suite(PolicySpec(text="copy"), ONE, channel=Channel(up=Link(delay=0.1)))
    write_bundle(tmp_path / "own", run, results(run, {}).plain())
    verdict = verify(tmp_path / "own")
    assert verdict.ok
    assert verdict.suite.endswith(", over the channel to the policy 0 ms; to the robot 100 ms")


@pytest.mark.parametrize(
    "channel",
    [
        CHANNELS["lan"],
        CHANNELS["satellite"],
        dataclasses.replace(HOME, up=dataclasses.replace(HOME.up, loss=0.3)),
    ],
    ids=["lan", "satellite", "lossier"],
)
def test_another_channel_than_the_lifts_had_is_refused(forged, channel):
    claim(forged, channel)
    assert "by the channel it must be" in refused(forged, file="traces.npz")


def test_the_channel_cannot_be_left_out(forged):
    edit_json(forged, "manifest.json", lambda content: content["recipe"].pop("channel"))
    mend(forged)
    assert refused(forged, file="results.json").startswith("channel says {")
    edit_json(
        forged, "manifest.json", lambda content: content["recipe"].update(channel=recorded(HOME))
    )
    edit_json(forged, "results.json", lambda content: content.pop("channel"))
    mend(forged)
    assert refused(forged, file="results.json").startswith("channel says nothing")


def test_an_answer_that_has_not_arrived_is_refused(forged):
    def early(arrays):
        arrays["internals/answered"][0] = 0.0

    edit_arrays(forged, early)
    mend(forged)
    message = refused(forged, file="traces.npz", step=0)
    assert message == "internals/answered is 0, by the channel it must be nan"


def test_a_move_without_an_answer_is_refused(forged):
    def move(arrays):
        arrays["action"][0, 0] = 0.01

    edit_arrays(forged, move)
    mend(forged)
    assert "no new answer has arrived" in refused(forged, file="traces.npz", step=0)


def test_the_answers_cannot_be_left_out(forged):
    edit_arrays(forged, lambda arrays: arrays.pop("internals/answered"))
    mend(forged)
    assert "is nan, by the channel it must be" in refused(forged, file="traces.npz")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda channel: channel["up"].update(delay=1),
            "up.delay must be written as colift does, 1.0, got 1",
        ),
        (lambda channel: channel["up"].update(delay=-1.0), "up.delay must be from 0 to 10 s"),
        (lambda channel: channel["up"].update(speed=1.0), "up: unknown key 'speed'"),
        (lambda channel: channel.pop("up"), "up is missing"),
        (lambda channel: channel.pop("code"), "channel: code is missing"),
        (
            lambda channel: channel.update(code="0" * 16),
            "the code of channels has changed since; run the policy again",
        ),
    ],
)
def test_a_recipe_with_a_malformed_channel_is_refused(forged, change, message):
    edit_json(forged, "manifest.json", lambda content: change(content["recipe"]["channel"]))
    mend(forged)
    assert message in refused(forged, file="manifest.json")


def test_a_bundle_without_a_channel_does_not_mention_one(made):
    for name in ("manifest.json", "results.json"):
        assert b"channel" not in (made / "copy" / name).read_bytes()
    numbers = np.load(made / "copy" / "traces.npz")
    assert not any("answered" in name for name in numbers)
    assert not math.isnan(numbers["action"].sum())
