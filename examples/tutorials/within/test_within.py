from colift.testing import check_suite, check_task
from within import Within, within_v1


def test_it_conforms():
    check_task(Within())
    check_suite(within_v1())
