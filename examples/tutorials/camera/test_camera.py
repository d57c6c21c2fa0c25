from camera import camera_v1
from colift.testing import check_suite


def test_it_conforms():
    check_suite(camera_v1())
