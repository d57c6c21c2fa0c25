"""Channels on the command line: runs, comparisons, prices."""

import json
import re

import pytest

QUICK = ("--suite", "quick-v1", "--seeds", "3:4", "--jobs", "1")


def test_a_run_over_a_channel_is_a_bundle_that_is_compared_with_its_like(colift, tmp_path):
    far = colift("run", "copy", *QUICK, "--channel", "home", "--out", tmp_path / "far")
    assert far.returncode == 0
    assert "copy on quick-v1[3:4], over the channel home" in far.stdout
    assert "Channel to the policy: 15 ms + 5" in far.stdout
    told = colift("compare", tmp_path / "far", "hold", "--jobs", "1", "--json")
    content = json.loads(told.stdout)
    assert content["channel"]["up"]["delay"] == 0.015
    rmse = {each["name"]: each["rmse_mm"]["mean"] for each in content["policies"]}
    assert f"{rmse['copy']:.2f} mm" in far.stdout
    near = colift("run", "copy", *QUICK, "--out", tmp_path / "near")
    assert "over the channel" not in near.stdout
    assert "Channel" not in near.stdout
    mixed = colift("compare", tmp_path / "far", tmp_path / "near", "--jobs", "1")
    assert mixed.returncode == 2
    assert "near was played over no channel, not over the channel home" in mixed.stderr
    out = tmp_path / "set"
    exported = colift("export", tmp_path / "far", "--to", "minari", "--out", out)
    assert exported.returncode == 2
    assert "far was played over a channel" in exported.stderr
    assert not out.exists()


def test_the_price_of_a_channel_is_measured_on_the_same_lifts(colift, tmp_path):
    (tmp_path / "own.toml").write_text("[up]\ndelay = 0.1\n")
    options = ("--channel", "own.toml", "--channel", "lan")
    told = colift("channels", "copy", "extrapolate", *options, *QUICK, "--json")
    content = json.loads(told.stdout)
    assert told.returncode == 0
    rows = {(each["policy"], each["channel"]): each for each in content["policies"]}
    assert len(rows) == 6
    for policy in ("copy", "extrapolate"):
        alone, own, lan = (rows[policy, name] for name in (None, "own.toml", "lan"))
        price = own["rmse_mm"]["mean"] - alone["rmse_mm"]["mean"]
        assert own["price_mm"]["mean"] == pytest.approx(price)
        assert price > 2
        assert lan["rmse_mm"] == alone["rmse_mm"]
        assert lan["price_mm"]["mean"] == 0.0


def test_the_table_has_a_column_for_each_channel(colift):
    told = colift("channels", "copy", "--channel", "home", *QUICK)
    assert told.returncode == 0
    assert "no channel" in told.stdout
    assert re.search(r"copy +\+\d+\.\d \(-?\d+\.\d to \d+\.\d\)", told.stdout)
    assert "home: 15 ms + 5 ± 6.6 ms (gamma), 1 % lost, 2 in a row, each way" in told.stdout


def test_list_has_the_numbers_of_each_channel(colift):
    told = colift("list", COLUMNS="200").stdout
    assert "satellite" in told
    assert "265 ms + 5 ± 6.6 ms (gamma), 1 % lost, 3 in a row, each way" in told


@pytest.mark.parametrize(
    ("command", "text", "message"),
    [
        ("run", "hoem", "--channel: unknown channel 'hoem'; did you mean home? known: lan, home"),
        ("channels", "no.toml", "--channel: no.toml: cannot be read: No such file"),
        ("run", "bad.toml", "--channel: bad.toml: up: unknown key 'lost'"),
        ("run", "far.toml", "--channel: far.toml: down.delay must be from 0 to 10 s, got 99 s"),
    ],
)
def test_a_channel_that_cannot_be_used_is_refused_in_a_line(
    colift, tmp_path, command, text, message
):
    (tmp_path / "bad.toml").write_text("[up]\nlost = 1\n")
    (tmp_path / "far.toml").write_text("[down]\ndelay = 99\n")
    told = colift(command, "copy", *QUICK, "--channel", text)
    assert told.returncode == 2
    assert message in " ".join(told.stderr.split())
