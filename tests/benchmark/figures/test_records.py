import dataclasses

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.base.registry import own_policies
from colift.benchmark.figures.origins import origin_of
from colift.benchmark.figures.records import (
    FigureRecord,
    file_hashes,
    read_records,
    reasons_due,
    write_records,
)
from colift.benchmark.figures.registry import RecordedFigure
from colift.benchmark.suites.suite import make_suite

FIGURE = RecordedFigure(
    name="table", command="colift list", suites=("quick-v1",), policies=("copy",)
)
ORIGIN = {"command": "colift list", "suite quick-v1": "a", "policy copy": "b"}
FILES = {"table.txt": "c"}
RECORD = FigureRecord(origin=ORIGIN, files=FILES)


def test_an_origin_has_the_digests_of_suites_policies_and_code(tmp_path):
    figure = dataclasses.replace(FIGURE, code=("benchmark.references.oracle:foreknow",))
    origin = origin_of(figure, tmp_path)
    assert origin["command"] == "colift list"
    assert origin["suite quick-v1"] == make_suite("quick-v1").digest
    assert origin["policy copy"] == PolicySpec(text="copy").digest()
    assert len(origin["code benchmark.references.oracle:foreknow"]) == 16
    everything = origin_of(dataclasses.replace(FIGURE, policies=("*",)), tmp_path)
    assert sum(name.startswith("policy ") for name in everything) == len(own_policies("level"))


@pytest.mark.parametrize(
    "place", ["benchmark.references.oracle:nothing", "benchmark.nowhere:x", "benchmark"]
)
def test_code_that_does_not_exist_is_an_error(place, tmp_path):
    with pytest.raises(InputError, match="there is no"):
        origin_of(dataclasses.replace(FIGURE, code=(place,)), tmp_path)


def test_a_script_of_the_command_is_part_of_the_origin(tmp_path):
    figure = dataclasses.replace(FIGURE, command="python examples/one.py > /dev/null")
    with pytest.raises(InputError, match=r"there is no 'examples/one\.py'"):
        origin_of(figure, tmp_path)
    (tmp_path / "examples").mkdir()
    script = tmp_path / "examples" / "one.py"
    script.write_text("print(1)")
    before = origin_of(figure, tmp_path)
    assert len(before["script examples/one.py"]) == 16
    script.write_text("print(2)")
    after = origin_of(figure, tmp_path)
    assert {name for name in after if after[name] != before[name]} == {"script examples/one.py"}


def test_a_figure_with_the_same_origin_and_files_is_current():
    assert reasons_due(FIGURE, ORIGIN, RECORD, FILES) == ()


@pytest.mark.parametrize(
    ("origin", "files", "reason"),
    [
        ({**ORIGIN, "suite quick-v1": "x"}, FILES, "suite quick-v1"),
        ({**ORIGIN, "command": "x"}, FILES, "command"),
        ({**ORIGIN, "policy hold": "x"}, FILES, "policy hold"),
        ({"command": "colift list", "suite quick-v1": "a"}, FILES, "policy copy"),
        (ORIGIN, {}, "table.txt missing"),
        (ORIGIN, {"table.txt": "x"}, "table.txt edited"),
    ],
)
def test_each_change_makes_a_figure_due(origin, files, reason):
    assert reasons_due(FIGURE, origin, RECORD, files) == (reason,)
    assert reasons_due(FIGURE, origin, None, files) == ("never made",)


def test_records_are_kept_for_registered_figures(tmp_path):
    assert read_records(tmp_path) == {}
    write_records(tmp_path, {"gone": RECORD, "table": RECORD}, ["other", "table"])
    assert read_records(tmp_path) == {"table": RECORD}
    assert file_hashes(tmp_path, FIGURE) == {}
    (tmp_path / "table.txt").write_text("")
    assert file_hashes(tmp_path, FIGURE)["table.txt"].startswith("e3b0c442")
