"""``colift statistics`` with few repetitions."""

import json

from colift.benchmark.statistics.simulation import BOARD_SAMPLES, BOARDS, SAMPLES
from colift.cli.main import main


def test_it_counts_coverage_and_false_differences(capsys):
    assert main(["statistics", "--repetitions", "20", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert len(told["coverage"]) == 4 * len(SAMPLES)
    assert len(told["false_splits"]) == len(BOARDS) * len(BOARD_SAMPLES)
    assert all(0.7 <= each["share"] <= 1.0 for each in told["coverage"])
    held = [each["share"] >= told["least_coverage"] for each in told["coverage"]]
    held += [each["share"] <= told["most_splits"] for each in told["false_splits"]]
    assert told["holds"] is all(held)


def test_the_check_fails_with_its_exit_code(monkeypatch, capsys):
    monkeypatch.setattr("colift.benchmark.statistics.simulation.LEAST_COVERAGE", 1.01)
    assert main(["statistics", "--repetitions", "20", "--check"]) == 1
    assert "95 % intervals that contain the true value" in capsys.readouterr().out
