"""``colift pairs`` as a user meets it, and the other commands on the same file."""

import csv
import json
import math

import pytest

LAG, GAIN, DIFFERENCE = 0.08, 1.1, 0.02


def height(time, top, peak):
    return top * math.exp(-(((time - peak) / 0.8) ** 2))


def rows(trial, person, top, peak):
    times = (k / 60 for k in range(301))
    return "".join(
        f"{trial},{person},{t:.5f},{1.0 + height(t, top, peak):.6f},"
        f"{1.0 - DIFFERENCE + GAIN * height(t - LAG, top, peak):.6f}\n"
        for t in times
    )


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "ours.csv"
    lifts = [("a", "AB", 0.2, 2.0), ("b", "AB", 0.25, 2.5), ("c", "CD", 0.15, 1.8)]
    path.write_text(
        "trial,person,t_s,z_m,z_far_m\n"
        + "".join(rows(*lift) for lift in lifts)
        + "d,CD,0,1,\n"
        + "".join(f"d,CD,{k / 60:.5f},{1 + height(k / 60, 0.2, 3.2):.6f},\n" for k in range(1, 301))
    )
    return path


def test_a_pair_of_known_lag_gain_and_tilt_comes_out_in_the_table(colift, file, tmp_path):
    done = colift("pairs", file, "--length", "1", "--out", tmp_path / "out", COLUMNS="120")
    assert done.returncode == 0
    assert "ours.csv: d does not count: the other end was not recorded" in done.stderr
    lines = {line.split("  ")[1]: line.split() for line in done.stdout.splitlines() if "  " in line}
    assert lines["lag, ms"][2] == "80.0"
    assert lines["gain"][1] == "1.100"
    assert float(lines["difference at start, mm"][4]) == pytest.approx(20.0, abs=0.1)
    assert "3 lifts of 2 pairs. Intervals over lifts hold for further lifts of these pairs" in (
        " ".join(done.stdout.split())
    )
    assert (tmp_path / "out" / "pairs.png").read_bytes().startswith(b"\x89PNG")


def test_files_and_json_have_each_lift_beside_the_simulated_one(colift, file, tmp_path):
    done = colift("pairs", file, "--out", tmp_path / "out", "--json")
    content = json.loads(done.stdout)
    assert content == json.loads((tmp_path / "out" / "pairs.json").read_text())
    assert [each["trial"] for each in content["lifts"]] == ["a", "b", "c"]
    assert (content["pairs"], content["without_far_end"]) == (2, ["d"])
    with (tmp_path / "out" / "pairs.csv").open() as text:
        table = list(csv.DictReader(text))
    for row, lift in zip(table, content["lifts"], strict=True):
        assert float(row["lag_ms"]) == lift["recorded"]["lag_ms"] == pytest.approx(80.0, abs=0.1)
        assert float(row["simulated_rmse_mm"]) == lift["simulated"]["rmse_mm"] > 1.0
    rmse = content["measures"]["rmse_mm"]
    assert rmse["over_pairs"]["ci95"][0] < rmse["recorded"]["ci95"][0]


@pytest.mark.slow
def test_it_is_the_same_to_the_byte_on_two_workers(colift, file, tmp_path):
    one, two = (
        colift("pairs", file, "--out", tmp_path / jobs, "--json", "--jobs", jobs) for jobs in "12"
    )
    assert one.returncode == 0
    assert one.stdout == two.stdout
    for name in ("pairs.csv", "pairs.png", "pairs.svg", "pairs.pdf"):
        assert (tmp_path / "1" / name).read_bytes() == (tmp_path / "2" / name).read_bytes()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["nowhere.csv"], "nowhere.csv: cannot be read"),
        (["plain.csv"], "needs the column z_far_m"),
        (["ours.csv", "--length", "12"], "the table's length is 12 m, must be from 0.2 to 5 m"),
        (["ours.csv", "--out", "ours.csv"], "--out"),
        ([], "FILE"),
    ],
)
def test_wrong_usage_is_refused(colift, file, arguments, told):
    plain = [line.rsplit(",", 1)[0] for line in file.read_text().splitlines()]
    file.with_name("plain.csv").write_text("\n".join(plain) + "\n")
    done = colift("pairs", *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("name", ["pairs.csv", "pairs.pdf"])
def test_neither_the_recordings_nor_another_file_are_replaced(colift, file, name):
    there = file.rename(file.with_name(name))
    content = there.read_bytes()
    done = colift("pairs", name, "--out", ".")
    assert (done.returncode, done.stdout) == (2, "")
    assert f"error: --out: {name} exists; name a new folder" in done.stderr
    assert [each.name for each in there.parent.iterdir()] == [name]
    assert there.read_bytes() == content


def test_recordings_are_played_as_they_were_and_told_so(colift, file, tmp_path):
    played = ("run", "copy", "--recordings", file, "--as-recorded")
    done = colift(*played, "--out", tmp_path / "bundle", COLUMNS="200")
    assert done.returncode == 0
    assert "copy on recordings ours.csv as recorded" in done.stdout
    first = done.stdout.splitlines()[0]
    assert first.startswith("Read 4 lifts: 60 Hz, moving 0.15 to 0.25 m, fastest 0.16 to 0.27 m/s")
    assert first.endswith("played as recorded.")
    assert colift("verify", tmp_path / "bundle").returncode == 0
    mixed = colift("compare", tmp_path / "bundle", "hold", "--recordings", file)
    assert mixed.returncode == 2
    assert "Traceback" not in mixed.stderr


def test_only_recordings_are_played_as_recorded(colift):
    done = colift("run", "copy", "--as-recorded")
    assert done.returncode == 2
    assert "--as-recorded needs --recordings" in done.stderr
