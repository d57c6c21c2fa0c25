"""``colift bench``: a bar or a limit that is missed is named, and ends it with exit code 1."""

from colift.benchmark.profiling import policies
from colift.cli import bench


def test_a_limit_that_is_missed_is_named(monkeypatch, colift):
    for module in (policies, bench):
        monkeypatch.setattr(module, "LIMIT_MS", 1e-6)
    monkeypatch.setattr(bench, "playing", lambda task: ["copy"])
    done = colift("bench", "--policies")
    assert done.returncode == 1
    assert done.stderr.startswith("missed: copy: a step takes ")
    assert "exceeded" in done.stdout
