import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.episode.drawn import DrawnHurdle
from colift.benchmark.rendering.cameras import CAMERAS, check_camera
from colift.benchmark.rendering.scene import Picture, Scene
from colift.benchmark.rendering.style import HUMAN, ROBOT
from PIL import ImageColor

SIZE = (240, 180)

HURDLE = DrawnHurdle(
    label="human's hurdle",
    where="human",
    height=0.25,
    start=10,
    stop=20,
    stay=5,
    nearest=12,
    missed=0.01,
)


def amount(picture: Picture, colour: str, strength: float = 0.97) -> int:
    """Return how many pixels have roughly the hue of a colour."""
    reference = np.array(ImageColor.getrgb(colour), dtype=float)
    pixels = picture.reshape(-1, 3).astype(float) + 1e-9
    cosine = pixels @ reference / np.linalg.norm(pixels, axis=1) / np.linalg.norm(reference)
    return int((cosine > strength).sum())


@pytest.mark.parametrize("partner", ["nao", "human"])
@pytest.mark.parametrize("camera", ["front", "top"])
def test_each_camera_shows_everybody_whole(partner: str, camera: str) -> None:
    scene = Scene(partner, camera=camera)
    for heights in ((0.0, 0.0), (0.29, 0.29), (-0.03, 0.10)):
        scene.pose(*heights)
        picture = scene.picture(*SIZE)
        edges = np.concatenate([picture[0], picture[-1], picture[:, 0], picture[:, -1]])
        assert edges.min() > 190  # Only the sky and the pale floor reach the edges.
        assert amount(picture, HUMAN) > 100
        assert amount(picture, ROBOT) > 20
    scene.close()


def test_cameras_show_different_sides() -> None:
    seen = {}
    for name in CAMERAS:
        scene = Scene("nao", camera=name)
        seen[name] = scene.picture(*SIZE)
        scene.close()
    pictures = list(seen.values())
    for i, one in enumerate(pictures):
        assert all((one != other).any(axis=-1).mean() > 0.1 for other in pictures[:i])
    near, far = (amount(seen[name], HUMAN) for name in ("close", "side"))
    assert near > 1.3 * far


def test_from_above_the_robot_is_on_the_left() -> None:
    scene = Scene("nao", camera="top")
    picture = scene.picture(*SIZE)
    scene.close()
    left, right = picture[:, :120], picture[:, 120:]
    assert amount(left, ROBOT) > amount(right, ROBOT)
    assert amount(left, HUMAN) < amount(right, HUMAN)


def test_an_unknown_camera_is_refused_with_what_is_near() -> None:
    with pytest.raises(InputError, match=r"'frnt'; did you mean front\?.*side, close, front, top"):
        check_camera("frnt")


def test_a_hurdle_is_bold_while_it_is_open() -> None:
    scene = Scene("nao", hurdles=(HURDLE,))
    without = Scene("nao")
    shown = {}
    for name, opened in (("closed", False), ("open", True)):
        scene.table.open([opened])
        shown[name] = scene.picture(640, 360)
    bare = without.picture(640, 360)
    scene.close()
    without.close()
    bar = {name: (picture != bare).any(axis=-1) for name, picture in shown.items()}
    assert 100 < bar["closed"].sum() < bar["open"].sum()
    rows = np.flatnonzero(bar["open"].any(axis=1))
    assert np.ptp(rows) < 12  # Nothing else than a level bar has changed.
    blue = shown["open"][bar["open"]]
    assert amount(blue, HUMAN) > 0.5 * len(blue)
