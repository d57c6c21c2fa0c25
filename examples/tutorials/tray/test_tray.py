from colift.testing import check_suite, check_task
from tray import Tray, tray_v1


def test_it_conforms():
    check_task(Tray())
    check_suite(tray_v1())
