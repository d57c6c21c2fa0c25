import pytest
from colift.agents.humans import Subject
from colift.base.errors import InputError
from colift.benchmark.references.held_out import FIRST_SEED, held_out_suite
from colift.benchmark.tasks.level.task import BEHAVIOURS


def test_every_new_person_moves_in_every_way():
    suite = held_out_suite(3, 2)
    assert suite.size == 3 * len(BEHAVIOURS) * 2
    assert {scenario.subject for scenario in suite.scenarios} == {
        Subject.draw(seed) for seed in range(FIRST_SEED, FIRST_SEED + 3)
    }
    assert suite.seeds == (FIRST_SEED, FIRST_SEED + 1)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [((0, 1), "at least 1 person"), ((1, 0), "at least 1 person"), ((1, 1, 199_999), "start at")],
)
def test_seeds_that_were_learned_from_are_refused(arguments, told):
    with pytest.raises(InputError, match=told):
        held_out_suite(*arguments)
