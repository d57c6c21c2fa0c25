"""``colift admit`` as a user meets it: what it refuses, and what it prints of a small suite."""

import json

import pytest
import typer
from colift.benchmark.admission.assessment import Admission
from colift.benchmark.admission.criteria import COORDINATION, Criterion
from colift.cli.admit import report


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["intent-v1", "--pairs", "2"], "--pairs must be 3 to 20, or 0 for none; got 2"),
        (
            ["standard-v1", "--pairs", "3"],
            "pairs can be trained for tasks with touch; 'level' has none",
        ),
        (["nothing"], "unknown suite 'nothing'"),
        (["ball-v1", "--people", "2"], "admission needs 3 people or more, got 2"),
        (["ball-v1", "--tune", "--people", "3"], "--tune takes none of --pairs, --people, --upd"),
        (["ball-v1", "--tune", "--updates", "0"], "--tune takes none of --pairs, --people, --upd"),
        (
            ["ball-v1", "--tune", "--out", "new"],
            "--tune takes none of --pairs, --people, --upd",
        ),
        (["ball-v1", "--jobs", "0"], "jobs must be at least 1, got 0"),
        (["ball-v1", "--updates", "5"], "--updates and --out are for suites with conditions or se"),
        (["session-v1", "--updates", "0", "--out", "new"], "--updates must be at least 1, got 0"),
        (["robust-v1", "--updates", "0", "--out", "new"], "--updates must be at least 1, got 0"),
        (["session-v1", "--out", "/dev/null/x"], "--out: /dev/null/x cannot be a folder: Not a d"),
        (["robust-v1", "--out", "."], "--out must be a new folder, . exists"),
        (["ball-v1", "--policy", "ball_calm"], "--policy is for --tune"),
        (["ball-v1", "--tune", "--policy", "copy"], "'copy' cannot be tuned; can be: ball_adm"),
        (["standard-v1", "--tune"], "'level' has no policies of its own"),
    ],
)
def test_what_it_cannot_do_is_refused_in_one_line(colift, tmp_path, arguments, words):
    done = colift("admit", *arguments)
    assert done.returncode == 2
    assert words in " ".join(done.stderr.split())
    assert "Traceback" not in done.stderr
    assert [*tmp_path.iterdir()] == []


@pytest.mark.slow
def test_the_control_stands_beside_a_suite_and_fails(colift):
    done = colift("admit", "ball-v1", "--people", "3", "--json")
    found = json.loads(done.stdout)
    assert [each["letter"] for each in found["criteria"]] == list("abcdef")
    assert found["control"]["suite"] == "standard-v1 (3 people)"
    verdicts = {each["letter"]: each["passed"] for each in found["control"]["criteria"]}
    assert verdicts["a"] is False
    assert verdicts["d"] is verdicts["e"] is None
    assert done.returncode == (0 if found["passed"] else 1)
    partner, _ = found["claims"].values()
    assert partner is found["passed"]
    for each in found["criteria"]:
        if each["passed"] is not None:
            assert each["ci95"][0] <= each["figure"] <= each["ci95"][1]


def test_what_a_criterion_hangs_on_is_printed(capsys):
    criterion = Criterion(
        letter="a", claim=COORDINATION, what="", bar="", detail="", passed=True, hangs_on=("x", "y")
    )
    found = Admission(suite="some", digest="", means={}, criteria=(criterion,), control=None)
    with pytest.raises(typer.Exit):
        report(found, as_json=False)
    printed = capsys.readouterr().out
    assert "a is undecided: it fails without any one of x and y\n" in printed
    assert f"{COORDINATION}: NOT SHOWN" in printed
