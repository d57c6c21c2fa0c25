"""``colift recordings``: from the files of a laboratory to a verdict, in two commands."""

import csv
import json
import subprocess
import sys

import numpy as np
import pytest
from colift.agents.humans import load_recordings
from colift.base.extras import how_to_install

from ..benchmark.recordings import motion_files as files
from ..benchmark.recordings.motion_files import Dialect


@pytest.fixture
def session(tmp_path):
    """Return three takes of two people, of two lifts each, as Vicon writes them."""
    made = []
    for k, name in enumerate(("S1_box", "S2_box", "S2_tray")):
        parts = [
            files.lift(100.0, top=0.3 + 0.05 * k, rise=1.0 + 0.25 * (2 * k + i)) for i in range(2)
        ]
        heights = np.concatenate([z for _, z in parts])
        placed = files.points(heights, "Z", ("RFIN", "C7"))
        placed["C7"][:, 2] = heights - 0.02 * np.sin(0.01 * np.arange(len(heights)))
        path = tmp_path / f"{name}.csv"
        path.write_bytes(files.vicon(np.arange(len(heights)) / 100, placed, Dialect(), 100.0))
        made.append(path)
    return made


def test_files_become_lifts_a_picture_and_the_next_command(colift, session, tmp_path):
    out = tmp_path / "lifts.csv"
    arguments = ("recordings", *session, "--marker", "RFIN", "--far", "C7", "--person", "S[0-9]")
    done = colift(*arguments, "--out", out, COLUMNS="200")
    assert done.returncode == 0, done.stderr
    assert "Read 3 recordings: a CSV file of Vicon Nexus" in done.stdout
    assert "S1_box.csv" in done.stdout
    assert done.stdout.endswith(f"Next:\n  colift validity {out}\n")
    lifts = load_recordings(out)
    assert [lift.name for lift in lifts][:2] == ["S1_box-1", "S1_box-2"]
    assert {lift.person for lift in lifts} == {"S1", "S2"}
    text = out.read_text()
    rows = [*csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))]
    assert [*rows[0]] == ["trial", "person", "t_s", "z_m", "phase", "z_far_m"]
    assert {row["phase"] for row in rows} == {"", "rise"}
    picture = tmp_path / "lifts.png"
    assert picture.read_bytes().startswith(b"\x89PNG")
    again = tmp_path / "again.csv"
    colift(*arguments, "--out", again)
    assert again.read_text() == text
    assert (tmp_path / "again.png").read_bytes() == picture.read_bytes()


@pytest.mark.slow
def test_a_verdict_follows_in_the_second_command(colift, session, tmp_path):
    out = tmp_path / "lifts.csv"
    assert colift("recordings", *session, "--marker", "RFIN", "--out", out).returncode == 0
    done = colift(
        "validity", out, "--policies", "copy,blend,anticipate,extrapolate", "--suite", "quick-v1"
    )
    assert done.returncode == 0, done.stderr
    assert "Read 6 lifts: 100 Hz" in done.stdout
    assert "verdict" in done.stdout


def test_without_a_file_to_write_it_shows_what_is_there(colift, session, tmp_path):
    done = colift("recordings", session[0], "--marker", "RFIN", COLUMNS="200")
    assert done.returncode == 0
    assert "Nothing is written: --out lifts.csv writes the lifts." in done.stdout
    assert sorted(tmp_path.iterdir()) == sorted(session)
    content = json.loads(colift("recordings", session[0], "--marker", "RFIN", "--json").stdout)
    [take] = content["recordings"]
    assert (take["marker"], take["up"], take["unit"], take["rate_hz"]) == (
        "Anna:RFIN",
        "Z",
        "mm",
        100.0,
    )
    assert [lift["trial"] for lift in take["lifts"]] == ["S1_box-1", "S1_box-2"]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--out", "S1_box.csv"), "--out: S1_box.csv exists; name a new file"),
        (("--out", "lifts.png"), "--out: cannot write lifts.png: its suffix must be .csv"),
        (
            ("--out", "keep.csv"),
            "--picture: keep.png exists; name a new file; without it, the picture is beside the",
        ),
        (("--picture", "keep.png"), "--picture: keep.png exists; name a new file"),
        (
            ("--out", "same.csv", "--picture", "same.csv"),
            "--picture: cannot write same.csv: its suffix must be .png",
        ),
        (("--picture", "lifts.pdf"), "cannot write lifts.pdf: its suffix must be .png"),
    ],
)
def test_no_file_is_replaced_or_has_two_contents(colift, session, tmp_path, options, told):
    (tmp_path / "keep.png").write_bytes(b"a picture")
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    done = colift("recordings", session[0].name, "--marker", "RFIN", *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_picture_alone_is_told_as_written(colift, session, tmp_path):
    done = colift(
        "recordings", session[0].name, "--marker", "RFIN", "--picture", "only.PNG", COLUMNS="200"
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith("written: only.PNG\n--out lifts.csv writes the lifts.\n")
    assert (tmp_path / "only.PNG").read_bytes().startswith(b"\x89PNG")


def test_licence_and_citation_go_with_the_lifts(colift, session, tmp_path):
    out, second = tmp_path / "lifts.csv", tmp_path / "again.csv"
    done = colift(
        *("recordings", *session, "--marker", "RFIN", "--out", out),
        *("--licence", "CC BY-SA 3.0", "--cite", 'Müller, "HDM05",\n2007'),
    )
    assert done.returncode == 0, done.stderr
    told = 'licence: CC BY-SA 3.0; cite: Müller, "HDM05", 2007'
    assert told in done.stdout
    assert told in colift("run", "copy", "--recordings", out).stderr
    assert colift("recordings", out, "--out", second, "--phases", "all").returncode == 0
    assert told in colift("run", "hold", "--recordings", second).stderr
    assert len(load_recordings(second)) == 6


def test_all_refusals_are_told_at_once_and_nothing_is_written(colift, session, tmp_path):
    still = tmp_path / "S1_static.csv"
    still.write_text("t_s,z_m\n" + "".join(f"{i / 100},0.9\n" for i in range(300)))
    empty = tmp_path / "S1_empty.csv"
    empty.write_text("")
    out = tmp_path / "lifts.csv"
    arguments = ("recordings", session[0], still, empty, "--out", out)
    done = colift(*arguments)
    assert done.returncode == 2
    assert "S1_static.csv: no lift: z_m moves 0.000 m along Z" in done.stderr
    assert "S1_empty.csv: the file is empty" in done.stderr
    assert "2 refusals in 3 files: nothing is written; --leave-out goes on" in done.stderr
    assert not out.exists()
    done = colift(*arguments, "--leave-out")
    assert done.returncode == 0
    assert done.stderr.count("left out: ") == 2
    assert len(load_recordings(out)) == 2


def test_a_file_that_is_given_twice_is_refused(colift, session, tmp_path):
    done = colift("recordings", session[0], session[0], "--out", tmp_path / "lifts.csv")
    assert done.returncode == 2
    assert "was a file given twice?" in done.stderr


def test_the_missing_library_is_named(tmp_path):
    path = tmp_path / "take.c3d"
    path.write_bytes(b"\x02P" + bytes(600))
    code = (
        "import sys; sys.modules['ezc3d'] = None\n"
        f"sys.argv = ['colift', 'recordings', {str(path)!r}]\n"
        "from colift.cli.main import main; main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2
    assert f"is read by the library ezc3d: {how_to_install('c3d')}" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("option", "value", "message"),
    [
        ("--up", "W", "--up must be X, Y, Z, -X, -Y or -Z, got 'W'"),
        ("--unit", "furlong", "--unit must be one of mm, cm"),
        ("--unit", "-1", "or a number of metres, got '-1'"),
        ("--rate", "0", "--rate must be positive, got 0"),
        ("--time-unit", "d", "--time-unit must be s, ms"),
        ("--between", "3:1", "--between must be A:B in seconds"),
        ("--phases", "rise,lower", "--phases must be rise;"),
        ("--fill", "-1", "--fill must not be negative, got -1"),
        ("--person", "(", "--person is no regular expression"),
        ("--person", "P[0-9]", "no part of the name matches --person 'P[0-9]'"),
        ("--out", "none/lifts.csv", "there is no folder none"),
    ],
)
def test_wrong_options_are_refused(colift, session, option, value, message):
    done = colift("recordings", session[0], f"{option}={value}")
    assert done.returncode == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr
