"""Whether a policy can play a task, before a lift is played."""

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.execution.fitting import check_fits
from colift.benchmark.suites.catalogue import make_scenario

CODE = """
class Sized:
    def __init__(self, size: int = 0) -> None:
        self.size = size

    def reset(self, seed):
        pass

    def act(self, observation):
        if len(observation) != self.size:
            raise ValueError(f"needs {self.size} numbers, got {len(observation)}")
        return [0.0]


class Unmade:
    def __init__(self) -> None:
        raise ValueError("no weights")
"""


@pytest.fixture
def spec(tmp_path):
    """Return what makes the policy of a class in a file."""
    path = tmp_path / "mine.py"
    path.write_text(CODE)
    return lambda text: PolicySpec(text=f"{path}:{text}")


def test_a_policy_of_another_task_is_refused_with_its_reason(spec):
    level, ball = make_scenario("smooth"), make_scenario("smooth", task="ball")
    policy = spec("Sized,size=10")
    check_fits(policy, ball)
    with pytest.raises(InputError) as refused:
        check_fits(policy, level)
    assert str(refused.value) == (
        f"policy {policy.name!r} is for the task 'ball', not for 'level', where it fails at once: "
        "step 0: ValueError: needs 10 numbers, got 5"
    )


@pytest.mark.parametrize("text", ["Sized,size=99", "Unmade"])
def test_the_failures_of_a_policy_that_fails_everywhere_are_its_result(spec, text):
    level = make_scenario("smooth")
    assert check_fits(spec(text), level).startswith(("step 0: ", "start: "))


def test_a_policy_that_answers_has_no_failure():
    assert check_fits(PolicySpec(text="copy"), make_scenario("smooth")) is None
