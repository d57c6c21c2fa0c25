"""``colift demonstrate`` and ``colift learn`` as a user meets them."""

import json

import pytest

ROWS = "lift,behaviour,subject,t_s,seen_human_m,seen_partner_m,human_m,human_m_s,partner_m,"


@pytest.fixture
def demonstrated(colift, tmp_path):
    """Return a folder with a few demonstrations."""
    code, told, errors = colift("demonstrate", "--lifts", "6", "--jobs", "1", "--out", "lifts.csv")
    assert (code, errors) == (0, "")
    assert told.startswith("6 lifts, ")
    return tmp_path


def test_a_file_that_exists_is_not_replaced(colift, demonstrated):
    before = (demonstrated / "lifts.csv").read_bytes()
    code, told, errors = colift("demonstrate", "--lifts", "1", "--out", "lifts.csv")
    assert (code, told) == (2, "")
    assert errors == "error: lifts.csv exists; name a new file\n"
    assert (demonstrated / "lifts.csv").read_bytes() == before


def test_demonstrations_are_the_same_with_more_workers(colift, demonstrated):
    code, _, _ = colift("demonstrate", "--lifts", "6", "--jobs", "2", "--out", "again.csv")
    assert code == 0
    again, lifts = demonstrated / "again.csv", demonstrated / "lifts.csv"
    assert again.read_bytes() == lifts.read_bytes()


def test_a_single_lift_is_told_in_the_singular(colift):
    _, told, _ = colift("demonstrate", "--lifts", "1", "--jobs", "1", "--out", "lift.csv")
    assert told.startswith("1 lift, ")


def test_a_model_is_learned_to_the_same_bytes_and_can_be_run(colift, demonstrated):
    pytest.importorskip("sklearn")
    options = ("--demonstrations", "lifts.csv", "--components", "3", "--practice", "2")
    for name in ("one.json", "other.json"):
        code, told, errors = colift("learn", "task_model", *options, "--out", name)
        assert (code, errors) == (0, "")
        assert "stiffness" in told
    one, other = demonstrated / "one.json", demonstrated / "other.json"
    assert one.read_bytes() == other.read_bytes()
    assert json.loads(one.read_text())["provenance"]["command"] == (
        "colift learn task_model --demonstrations lifts.csv --components 3 --seed 0 --practice 2"
    )
    options = ("--suite", "quick-v1", "--seeds", "40:41", "--jobs", "1", "--json")
    code, told, _ = colift("run", "task_model,model=one.json", *options)
    assert code == json.loads(told)["summary"]["failed"] == 0


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["demonstrate"], "--out"),
        (["demonstrate", "--out", "/nowhere/x.csv"], "no folder /nowhere"),
        (
            ["demonstrate", "--out", "x.csv", "--seed", "3"],
            "seeds for learning are 60000 to 199999",
        ),
        (["demonstrate", "--out", "x.csv", "--lifts", "0"], "lifts must be at least 1, got 0"),
        (["learn", "task_model", "--practice", "0"], "--practice must be at least 1, got 0"),
        (["learn", "task_model", "--out", "/nowhere/x.json"], "no folder /nowhere"),
        (["learn", "everything"], "cannot learn 'everything'; can learn: reactive, task_model"),
        (["learn"], "a command is missing; 'colift learn --help' lists them"),
    ],
)
def test_wrong_usage_is_one_clear_line_and_exit_code_2(colift, tmp_path, arguments, told):
    code, output, errors = colift(*arguments)
    assert code == 2
    assert told in output + errors
    if errors.startswith("error:"):
        assert errors.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_bad_file_of_demonstrations_is_named(colift, tmp_path):
    pytest.importorskip("sklearn")
    (tmp_path / "bad.csv").write_text(ROWS + "\n")
    code, _, errors = colift("learn", "task_model", "--demonstrations", "bad.csv")
    assert code == 2
    assert errors == "error: bad.csv: missing column(s) partner_m_s\n"


def test_the_commands_explain_themselves(colift, tmp_path):
    for command in (["demonstrate"], ["learn", "reactive"], ["learn", "task_model"]):
        code, told, _ = colift(*command, "--help")
        assert code == 0
        assert "--seed" in told
