from colift.testing import check_behaviour
from twice import Twice


def test_it_conforms():
    check_behaviour(Twice())
