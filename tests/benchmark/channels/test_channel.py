"""Channels: ranges, names, files."""

import pytest
from colift.base.errors import InputError
from colift.base.identity import Code, code_hash
from colift.benchmark.channels import (
    CHANNELS,
    Channel,
    Link,
    channel_name,
    make_channel,
)
from colift.benchmark.channels.reading import LONGEST, parse_channel
from colift.benchmark.channels.recorded import parse_recorded, recorded
from colift.benchmark.channels.teleoperated import teleoperated
from scipy.stats import gamma

WHOLE = {"delay": 0.1, "jitter": "gamma", "jitter_mean": 0.0, "jitter_deviation": 0.0}
WHOLE |= {"loss": 0.0, "burst": 1.0}


@pytest.fixture
def file(tmp_path):
    """Return a function that writes a channel's file, and reads it."""

    def read(text):
        path = tmp_path / "own.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return make_channel(str(path))

    return read


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"delay": -0.1}, "delay must be from 0 to 10 s, got -0.1 s"),
        ({"delay": float("nan")}, "delay must be from 0 to 10 s, got nan s"),
        ({"delay": float("inf")}, "delay must be from 0 to 10 s"),
        ({"jitter_mean": 11.0}, "jitter_mean must be from 0 to 10 s"),
        ({"jitter_deviation": 0.1}, "at most 100 times jitter_mean"),
        ({"jitter": "uniform"}, "jitter must be gamma or lognormal, got 'uniform'"),
        ({"loss": 1.1}, "loss must be from 0 to 1"),
        ({"burst": 0.5}, "burst must be from 1 to 1000"),
        ({"loss": 0.75, "burst": 2.0}, "burst must be at least loss / [(]1 - loss[)] = 3"),
    ],
)
def test_a_number_out_of_range_is_refused_with_the_range(numbers, message):
    with pytest.raises(InputError, match=message):
        Link(**numbers)


def test_each_named_channel_is_found_by_name_and_by_its_numbers():
    for name, channel in CHANNELS.items():
        assert make_channel(name) == channel
        assert channel_name(Channel(**vars(channel))) == name
    assert channel_name(Channel(down=Link(delay=0.02))) == "to the policy 20 ms; to the robot 0 ms"


def test_the_jitter_of_the_wide_channels_is_within_the_limit_of_y_1541():
    for name in ("home", "satellite"):
        for link in (CHANNELS[name].down, CHANNELS[name].up):
            spread = (link.jitter_deviation / link.jitter_mean) ** 2
            slowest = gamma.ppf(0.999, 1 / spread, scale=link.jitter_mean * spread)
            assert 0.045 < slowest <= 0.05


def test_a_file_has_the_numbers_that_differ_from_the_defaults(file):
    channel = file("[down]\ndelay = 1\njitter = 'lognormal'\njitter_mean = 0.01\n[up]\nloss = 1\n")
    down = Link(delay=1.0, jitter="lognormal", jitter_mean=0.01)
    assert channel == Channel(down=down, up=Link(loss=1.0))
    assert file("") == Channel()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[dwon]\n", "unknown key 'dwon'; did you mean down[?] known: down, up"),
        ("[up]\ndealy = 1\n", "up: unknown key 'dealy'; did you mean delay"),
        ("down = 3\n", "down must be a table, got 3"),
        ("[up]\ndelay = '1'\n", "up.delay must be a number, got '1'"),
        ("[up]\nloss = true\n", "up.loss must be a number, got True"),
        ("[up]\njitter = 3\n", "up.jitter must be a text, got 3"),
        ("[up]\ndelay = 11\n", "own.toml: up.delay must be from 0 to 10 s, got 11 s"),
        ("[up]\ndelay = nan\n", "up.delay must be from 0 to 10 s, got nan s"),
        ("[up\n", "own.toml: "),
        (b"\xff", "must be UTF-8; byte 0"),
        ("#" * (LONGEST + 1), f"more than {LONGEST} bytes"),
        ("[a" + ".a" * 4000 + "]\n", "own.toml: "),
    ],
)
def test_a_file_that_is_no_channel_is_refused_by_place(file, text, message):
    with pytest.raises(InputError, match=message):
        file(text)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("hoem", "unknown channel 'hoem'; did you mean home[?] known: lan, home, satellite"),
        ("missing.toml", "missing.toml: cannot be read: No such file"),
        (".", ".: cannot be read: Is a directory"),
    ],
)
def test_a_name_without_a_channel_is_refused(text, message):
    with pytest.raises(InputError, match=message):
        make_channel(text)


def test_a_recipe_has_all_numbers_as_floats():
    whole = {"down": dict(WHOLE), "up": dict(WHOLE)}
    channel = parse_channel(whole, "it", whole=True)
    assert channel.plain() == whole
    with pytest.raises(InputError, match=r"it: up is missing"):
        parse_channel({"down": dict(WHOLE)}, "it", whole=True)
    with pytest.raises(
        InputError, match=r"it: up.delay must be written as colift does, 1.0, got 1"
    ):
        parse_channel({**whole, "up": {**WHOLE, "delay": 1}}, "it", whole=True)


def test_a_bundle_has_the_hash_of_all_that_delays_and_loses_a_message():
    assert parse_recorded(recorded(CHANNELS["home"]), "it") == CHANNELS["home"]
    used = {each.name for each in Code().definitions(teleoperated, Channel, Link)}
    assert {
        "schedule",
        "link_delays",
        "_jitter",
        "_arrived",
        "Teleoperated",
        "channel_seed",
    } <= used
    assert code_hash(teleoperated, Channel, Link) == recorded(CHANNELS["lan"])["code"]
