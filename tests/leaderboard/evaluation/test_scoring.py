"""What a log says of failed lifts: equal errors once."""

import dataclasses

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.evaluation.scoring import MOST, failure_lines

CODE = """
class Broken:
    def reset(self, seed): self.left = None
    def act(self, observation):
        if self.left is None:
            self.left = int(1e7 * abs(observation[0])) % 5
        self.left -= 1
        if self.left < 0:
            raise RuntimeError("my own mistake")
        return [0.0]
"""


@pytest.fixture(scope="module")
def broken(tmp_path_factory):
    """Lifts that fail in the same way, in different steps."""
    path = tmp_path_factory.mktemp("broken") / "broken.py"
    path.write_text(CODE)
    return run_suite(PolicySpec(text=f"{path}:Broken"), make_suite("quick-v1")).episodes


def test_equal_errors_are_one_line_with_their_number(broken):
    assert len({episode.failure for episode in broken}) > 1
    first = broken[0].failure.partition(":")[0]
    assert failure_lines(broken) == [
        f"12 lifts: RuntimeError: my own mistake (first: smooth/draw-1 seed 0, {first})"
    ]


def test_the_most_frequent_error_comes_first_and_what_did_not_fail_is_not_told(broken):
    table = dataclasses.replace(broken[5], failure="the table was dropped")
    fine = dataclasses.replace(broken[0], failure=None)
    place = f"{table.behaviour}/{table.subject} seed {table.seed}"
    assert (
        failure_lines([fine, table, *broken[:2]])[1]
        == f"1 lift: the table was dropped (first: {place})"
    )
    assert failure_lines([fine]) == []


def test_no_more_than_some_different_errors_are_told(broken):
    many = [dataclasses.replace(broken[0], failure=f"step 1: error {i}") for i in range(MOST + 3)]
    assert len(failure_lines(many)) == MOST + 1
    assert failure_lines(many)[-1] == "and 3 other errors"
