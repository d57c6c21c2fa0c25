"""``colift train`` as a user meets it."""

import json

import pytest
from colift.benchmark.training import validation
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.cem import CemSettings
from colift.cli.train import next_commands

TINY = ("--generations", "1", "--population", "3", "--elite", "1", "--lifts", "1", "--jobs", "1")


@pytest.fixture(autouse=True)
def one_lift_to_validate(monkeypatch):
    monkeypatch.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:1])


def test_a_folder_per_seed_a_table_and_policies_that_run(colift, tmp_path):
    done = colift("train", "cem", "--seeds", "2", "--out", "out", *TINY)
    assert (done.returncode, done.stderr) == (0, "")
    assert "mean ± SD" in done.stdout
    assert "written: out/summary.csv" in done.stdout
    out = tmp_path / "out"
    assert len((out / "summary.csv").read_text().splitlines()) == 3
    options = ("--suite", "quick-v1", "--seeds", "40:41", "--jobs", "1", "--json")
    run = colift("run", "out/seed-1", *options)
    assert json.loads(run.stdout)["summary"]["failed"] == 0

    weights = (out / "seed-0" / "weights.npz").read_bytes()
    again = colift("train", "cem", "--seeds", "2", "--out", "out", *TINY)
    assert again.stdout == done.stdout
    assert (out / "seed-0" / "weights.npz").read_bytes() == weights
    other = colift("train", "cem", "--out", "out", *TINY, "--elite", "2")
    assert other.returncode == 2
    assert "of another training: elite is 1, not 2" in other.stderr


@pytest.mark.parametrize(
    ("settings", "suite"),
    [
        (CemSettings(), ""),
        (ApgSettings(), ""),
        (ApgSettings(task="ball"), " --suite ball-v1"),
        (ApgSettings(session="forget"), " --suite session-v1"),
    ],
)
def test_what_comes_next_is_on_the_suite_that_was_trained_for(settings, suite):
    assert next_commands("t", settings) == f"colift run t{suite}, or colift check t{suite}"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["train"], "a command is missing; 'colift train --help' lists them"),
        (["train", "sac"], "no trainer 'sac'; trainers: cem"),
        (["train", "cem"], "--out"),
        (["train", "cem", "--out", "x", "--seeds", "0"], "--seeds must be 1 to 100, got 0"),
        (["train", "cem", "--out", "x", "--elite", "99"], "elite must be below population"),
        (["train", "cem", "--out", "x", "--lifts", "90001"], "lifts must be at most 90000"),
        (["train", "ppo", "--out", "x"], "no trainer 'ppo'; trainers: cem, apg"),
        (
            ["train", "apg", "--out", "x", "--device", "tpu"],
            "must be cpu or gpu, got 'tpu'",
        ),
        (["train", "apg", "--out", "x", "--task", "tea"], "unknown task 'tea'; known: "),
        (["train", "apg", "--out", "x", "--lifts", "0"], "--lifts must be 2 to 90000, got 0"),
        (
            ["train", "apg", "--out", "x", "--session", "sometimes"],
            "--session must be remember or forget, got 'sometimes'",
        ),
        (["train", "cem", "--out", "/dev/null"], "cannot use /dev/null"),
        (["train", "cem", "--out", "x", "--jobs", "0"], "jobs must be at least 1, got 0"),
    ],
)
def test_wrong_usage_is_one_clear_line_and_exit_code_2(colift, tmp_path, arguments, told):
    done = colift(*arguments)
    assert done.returncode == 2
    assert told in done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "x").exists()
