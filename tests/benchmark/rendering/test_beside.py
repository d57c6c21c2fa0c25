import dataclasses
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.beside import (
    CURVE,
    GUTTER,
    LEVEL,
    SCENE,
    TITLE,
    WIDTH,
    Partner,
    film_beside,
    frames_beside,
    still_beside,
)
from colift.benchmark.rendering.film import Look
from colift.benchmark.rendering.scene import Picture
from colift.benchmark.rendering.style import ROBOT
from colift.benchmark.suites.catalogue import make_scenario
from PIL import Image, ImageColor, ImageSequence


def nearer(episode: Episode, rest: float) -> Episode:
    """Return the same lift with another distance of the robot's end from the human's [m]."""
    trace = dataclasses.replace(episode.trace, robot_end=episode.trace.human_end - rest)
    return dataclasses.replace(episode, trace=trace)


@pytest.fixture
def partners(long_episode: Episode, scenario: Scenario) -> Sequence[Partner]:
    people = make_scenario("smooth", partner="human")
    return (
        Partner(name="copy", episode=long_episode, scenario=scenario),
        Partner(name="two people", episode=nearer(long_episode, 0.005), scenario=people),
    )


def panel(picture: Picture, column: int) -> Picture:
    left = column * (WIDTH + GUTTER)
    return picture[:, left : left + WIDTH]


def orange(picture: Picture, column: int) -> int:
    """Return the pixels of the error's curve."""
    strip = panel(picture, column)[TITLE + SCENE + LEVEL : TITLE + SCENE + LEVEL + CURVE]
    area = np.array(ImageColor.getrgb("#F3C9AE"))
    return int((np.abs(strip.astype(int) - area) < 4).all(axis=-1).sum())


def test_each_partner_has_a_panel_and_the_errors_have_one_scale(partners) -> None:
    first, *_, last = frames_beside(partners, fps=1)
    assert first.shape == last.shape
    assert first.shape[1] == 2 * WIDTH + GUTTER
    assert orange(first, 0) < orange(last, 0) / 4
    assert orange(last, 0) == pytest.approx(4 * orange(last, 1), rel=0.25)


def test_a_still_shows_the_largest_error_and_the_whole_curves(partners) -> None:
    *_, last = frames_beside(partners, fps=1)
    still = still_beside(partners)
    assert orange(still, 0) == orange(last, 0)
    assert (still[TITLE : TITLE + SCENE] != last[TITLE : TITLE + SCENE]).any()


def test_a_lift_that_ended_early_stands_still(partners, dropped: Episode) -> None:
    copy, people = partners
    failed = dataclasses.replace(copy, name="failed", episode=dropped)
    pictures = list(frames_beside((failed, people), fps=2))
    assert np.array_equal(panel(pictures[3], 0), panel(pictures[-1], 0))
    assert not np.array_equal(panel(pictures[3], 1), panel(pictures[-1], 1))


def test_a_film_plays_as_often_and_as_fast_as_asked(partners, tmp_path: Path) -> None:
    told: list[int] = []
    film_beside(tmp_path / "a.webp", partners, look=Look(speed=12.5, plays=1), drawn=told.append)
    with Image.open(tmp_path / "a.webp") as film:
        times = [each.copy().info["duration"] for each in ImageSequence.Iterator(film)]
        assert film.info["loop"] == 1
    assert times == [80] * len(told)
    assert len(told) == 8  # 6.8 s in 0.54 s, and the last.
    film_beside(tmp_path / "a.png", partners)
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.size[0] == 2 * WIDTH + GUTTER


def test_the_partner_s_colour_is_that_of_the_error(partners) -> None:
    still = still_beside(partners)
    line = np.array(ImageColor.getrgb(ROBOT))
    assert (np.abs(panel(still, 1).astype(int) - line) < 12).all(axis=-1).sum() > 200


def test_a_partner_without_a_lift_is_refused(partners, empty_episode: Episode) -> None:
    none = dataclasses.replace(partners[0], episode=empty_episode)
    with pytest.raises(InputError, match="ended at once"):
        next(frames_beside((partners[1], none)))


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"camera": "below"}, "unknown camera 'below'"),
        ({"speed": 0.0}, "speed must be within 0.125 to 12.5, got 0.0"),
        ({"speed": float("nan")}, "speed must be within"),
        ({"plays": -1}, "plays must not be negative, got -1"),
    ],
)
def test_an_impossible_look_is_refused(given, words: str) -> None:
    with pytest.raises(InputError, match=words):
        Look(**given)
