import numpy as np
import pybullet
import pytest
from colift.robots.description import rotations


def test_quarter_turn_about_z_takes_x_to_y() -> None:
    np.testing.assert_allclose(
        rotations.about((0, 0, 2), np.pi / 2) @ [1, 0, 0], [0, 1, 0], atol=1e-15
    )


def test_turns_of_an_array_are_the_turns_of_its_elements() -> None:
    angles = np.array([[0.1, -2.0], [3.0, 0.7]])
    turns = rotations.about((1, 2, -1), angles)
    assert turns.shape == (2, 2, 3, 3)
    np.testing.assert_array_equal(turns[1, 0], rotations.about((1, 2, -1), 3.0))


@pytest.mark.parametrize("rpy", [(0.3, -1.2, 2.5), (-3.0, 0.4, -0.1), (1.2554, 0.9767, -0.264)])
def test_rpy_means_what_the_engine_means_and_comes_back(rpy: tuple[float, float, float]) -> None:
    engine = pybullet.getMatrixFromQuaternion(pybullet.getQuaternionFromEuler(rpy))
    rotation = rotations.from_rpy(rpy)
    np.testing.assert_allclose(rotation, np.reshape(engine, (3, 3)), atol=1e-12)
    np.testing.assert_allclose(rotations.to_rpy(rotation), rpy, atol=1e-12)


@pytest.mark.parametrize("pitch", [np.pi / 2, -np.pi / 2])
def test_right_angle_of_pitch_keeps_its_rotation(pitch: float) -> None:
    rotation = rotations.from_rpy((0.4, pitch, -0.9))
    again = rotations.from_rpy(rotations.to_rpy(rotation))
    np.testing.assert_allclose(again, rotation, atol=1e-12)
