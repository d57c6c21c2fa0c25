"""Commands on recordings: one line on what was read and done to it, and refusals before a lift."""

import json

import pytest

HEADER = "trial,t_s,z_m\n"
SMALL = ("--seeds", "0:1", "--jobs", "1")


def rows(trial, top, up=30, down=False):
    """Return the rows of a lift that rises for some frames, and falls in the rest of 60."""
    heights = (top * min(k / up, (60 - k) / (60 - up)) for k in range(61))
    return "".join(
        f"{trial},{k / 50:.2f},{1.0 + (-each if down else each):.4f}\n"
        for k, each in enumerate(heights)
    )


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "lifts.csv"
    path.write_text(HEADER + rows("a", 0.4) + rows("b", 0.05, 20) + rows("c", 0.5, 40, down=True))
    return path


def test_one_line_tells_what_was_read_and_done_to_it(colift, file, tmp_path):
    done = colift("run", "copy", "--recordings", file, "--out", tmp_path / "out", COLUMNS="300")
    assert done.returncode == 0
    first, people, *_ = done.stdout.splitlines()
    assert first == (
        "Read 3 lifts: 50 Hz, moving 0.05 to 0.50 m, scaled 0.41 to 4.16, slowed down 1.7 to 2.6 "
        "times, 1 inverted (further down than up), 1 enlarged more than 2 times, noise included."
    )
    assert people == (
        "Intervals and tests hold for further lifts of the same people, however few. Of fewer than "
        "10 lifts, they say little."
    )
    table = (tmp_path / "out" / "episodes.csv").read_text().splitlines()
    assert table[0].endswith(",rate_hz,range_m,scale,slow_down,inverted")
    assert [row.rsplit(",", 1)[1] for row in table[1:]] == ["False", "False", "True"]


def test_json_has_the_same_numbers_by_trial(colift, file, tmp_path):
    content = json.loads(colift("run", "copy", "--recordings", file, "--json").stdout)
    assert [each["trial"] for each in content["recordings"]] == ["a", "b", "c"]
    found = content["recordings"][1]
    assert (found["rate_hz"], found["range_m"], found["inverted"]) == (50.0, 0.05, False)
    assert found["scale"] == pytest.approx(0.2 / 0.05, rel=0.05)  # The corner is smoothed.
    other = json.loads(
        colift("compare", "copy", "hold", "--recordings", file, "--jobs", "1", "--json").stdout
    )
    assert other["recordings"] == content["recordings"]
    suite = colift("run", "copy", "--suite", "quick-v1", *SMALL, "--json")
    assert "recordings" not in json.loads(suite.stdout)


@pytest.mark.parametrize(
    "command",
    [
        ("run", "copy", "--recordings"),
        ("compare", "copy", "hold", "--recordings"),
        ("channels", "copy", "--recordings"),
        ("validity",),
        ("export", "--set", "recorded", "--out", "set", "--recordings"),
        ("render", "copy", "--out", "lift.gif", "--scenario", "recorded:lifts.csv"),
    ],
)
def test_every_command_refuses_an_artefact_by_line(colift, file, command):
    file.write_text(file.read_text().replace("b,0.60,1.0375", "b,0.60,0"))
    arguments = command if command[0] == "render" else (*command, file.name)
    done = colift(*arguments)
    assert done.returncode == 2
    assert "lifts.csv, line 93: trial 'b' z_m is 0 in 1 of 61 samples" in done.stderr
    assert done.stdout == ""
    assert "Traceback" not in done.stderr


def test_a_session_of_nobody_who_is_named_is_told(colift, file):
    done = colift("run", "copy", "--recordings", file, "--session", "--jobs", "1")
    assert done.returncode == 0
    told = "lifts.csv: no person is named, so all lifts are taken as one person's"
    assert told in done.stderr.splitlines()


def test_a_file_of_copies_is_refused(colift, file):
    file.write_text(HEADER + "".join(rows(f"copy{k}", 0.3) for k in range(8)))
    done = colift("validity", file)
    assert done.returncode == 2
    assert "trial 'copy1' is the same lift as 'copy0': keep one of them" in done.stderr
