from colift.testing import check_robot
from crane import Crane


def test_it_conforms():
    check_robot(Crane())
