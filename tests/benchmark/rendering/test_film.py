from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.film import (
    film_episode,
    frames,
    shown_frames,
    still_moments,
    still_picture,
)
from colift.benchmark.suites.catalogue import make_scenario
from PIL import Image


def test_film_shows_every_eighth_frame_and_the_last(long_episode: Episode) -> None:
    shown = shown_frames(long_episode)
    assert shown[:3] == [0, 8, 16]
    assert shown[-1] == 679
    assert len(shown) == 86


def test_film_of_100_pictures_a_second_shows_every_frame(long_episode: Episode) -> None:
    assert shown_frames(long_episode, fps=100) == list(range(680))


@pytest.mark.parametrize("fps", [1, 7, 12.5, 30, 60, 99])
def test_no_frame_is_shown_twice(long_episode: Episode, fps: float) -> None:
    shown = shown_frames(long_episode, fps)
    assert sorted(set(shown)) == shown
    assert len(shown) == pytest.approx(6.8 * fps, abs=2)


@pytest.mark.parametrize("fps", [0.0, -5.0, 101.0, float("nan")])
def test_impossible_frame_rate_is_refused(episode: Episode, fps: float) -> None:
    with pytest.raises(InputError, match="fps must be within 1 to 100"):
        shown_frames(episode, fps)


def test_pictures_of_a_film_are_alike_in_size_and_not_in_content(
    episode: Episode, scenario: Scenario
) -> None:
    first, *_, last = frames(episode, scenario, "copy")
    assert first.shape == last.shape == (600, 640, 3)
    assert first.dtype == np.uint8
    assert not np.array_equal(first[36:396], last[36:396])
    assert not np.array_equal(first[396:], last[396:])
    assert np.array_equal(first[:36], last[:36])


def test_film_is_written_and_told(episode: Episode, scenario: Scenario, tmp_path: Path) -> None:
    told: list[int] = []
    film_episode(tmp_path / "lift.gif", episode, scenario, "copy", drawn=told.append)
    with Image.open(tmp_path / "lift.gif") as film:
        assert (film.size, getattr(film, "n_frames", 1)) == ((640, 600), 3)
    assert told == [1] * len(shown_frames(episode))


def test_still_is_written(dropped: Episode, tmp_path: Path) -> None:
    film_episode(tmp_path / "lift.png", dropped, make_scenario("smooth", partner="human"), "a")
    with Image.open(tmp_path / "lift.png") as picture:
        assert picture.size == (1290, 890)


def test_still_has_three_moments_over_the_curves(episode: Episode, scenario: Scenario) -> None:
    picture = still_picture(episode, scenario, "copy")
    assert picture.shape == (890, 1290, 3)
    first, second, third = (picture[64:490, x : x + 426] for x in (0, 432, 864))
    assert not np.array_equal(first, third)
    assert second.shape == first.shape


def test_a_still_shows_moments_that_differ(long_episode: Episode, dropped: Episode) -> None:
    """Larger errors just behind the start, and beside the highest place, are not shown twice."""
    robot = long_episode.trace.robot_end.copy()
    robot[[3, 400, 670]] -= 0.1, 0.05, 0.1
    trace = replace(long_episode.trace, robot_end=robot)
    assert still_moments(replace(long_episode, trace=trace)) == [0, 400, 679]
    assert still_moments(dropped)[::2] == [0, 9]


def test_a_lift_that_never_began_cannot_be_shown(
    empty_episode: Episode, scenario: Scenario, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="ZeroDivisionError"):
        film_episode(tmp_path / "lift.gif", empty_episode, scenario, "copy")
    assert not list(tmp_path.iterdir())


def test_last_picture_of_a_failed_lift_says_why(
    episode: Episode, dropped: Episode, scenario: Scenario
) -> None:
    *_, fine = frames(episode, scenario, "copy", fps=1)
    before, last = frames(dropped, scenario, "copy", fps=1)
    changed = np.flatnonzero((fine[36:] != last[36:]).any(axis=(1, 2)))
    assert changed.min() > 320
    assert changed.max() < 360
    assert not np.array_equal(before[36:], last[36:])
