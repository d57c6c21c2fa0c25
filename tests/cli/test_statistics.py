"""``colift statistics`` with few repetitions."""

import json

from colift.benchmark.statistics.simulation import BOARD_SAMPLES, BOARDS, SAMPLES


def test_it_counts_coverage_and_false_differences(colift):
    done = colift("statistics", "--repetitions", 20, "--json")
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert len(told["coverage"]) == 4 * len(SAMPLES)
    assert len(told["false_splits"]) == len(BOARDS) * len(BOARD_SAMPLES)
    assert all(0.7 <= each["share"] <= 1.0 for each in told["coverage"])
    held = [each["share"] >= told["least_coverage"] for each in told["coverage"]]
    held += [each["share"] <= told["most_splits"] for each in told["false_splits"]]
    assert told["holds"] is all(held)


def test_the_check_fails_with_its_exit_code(colift, monkeypatch):
    monkeypatch.setattr("colift.benchmark.statistics.simulation.LEAST_COVERAGE", 1.01)
    done = colift("statistics", "--repetitions", 20, "--check")
    assert done.returncode == 1
    assert "95 % intervals that contain the true value" in done.stdout
