"""A finished lift as a film, or as one picture."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.base.errors import InputError
from colift.benchmark.episode.drawn import (
    DrawnSeries,
    ball_and_target,
    intended_far_end,
    shown_error,
)
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.bodies import label_of
from colift.benchmark.rendering.caption import readout, title_strip
from colift.benchmark.rendering.curves import Curves
from colift.benchmark.rendering.scene import Picture, Scene
from colift.benchmark.rendering.style import PAPER
from colift.benchmark.rendering.writing import check_film, write
from PIL import Image

FPS: Final = 12.5
"""Pictures per second: 80 ms each, which a GIF can represent exactly."""

WIDTH: Final = 640
TITLE, SCENE, CURVES = 36, 360, 204
"""Heights of a film's three strips [pixels]; 600 together."""

STILL_WIDTH: Final = 1290
STILL_TITLE, STILL_SCENE, STILL_CURVES = 64, 426, 400
GUTTER: Final = 6
"""Gap between two scenes of a still [pixels]."""

APART: Final = 60
"""Least distance of a still's moments [frames], in lifts that are long enough."""


def shown_frames(episode: Episode, fps: float = FPS) -> list[int]:
    """Return the frames of the trace that a film of the episode shows: evenly, and the last.

    Raises
    ------
    InputError
        If the episode ended before its first frame, or ``fps`` is not within 1 to 100.
    """
    count = len(episode.trace.human_end)
    if count == 0:
        raise InputError(f"nothing to show: the lift ended at once ({episode.failure})")
    if not 1 <= fps <= 1 / FRAME:
        raise InputError(f"fps must be within 1 to {1 / FRAME:.0f}, got {fps}")
    frames = np.arange(0, count - 1, 1 / (fps * FRAME)).astype(int)
    return [*frames.tolist(), count - 1]


def frames(
    episode: Episode, scenario: Scenario, policy: str, *, fps: float = FPS
) -> Iterator[Picture]:
    """Yield the pictures of a film: title, scene from the side, curves with a moving cursor.

    Parameters
    ----------
    episode
        A finished episode.
    scenario
        Its scenario.
    policy
        Name of the policy, for the title.
    fps
        Pictures for each second of the lift.

    Raises
    ------
    InputError
        As :func:`shown_frames`.
    """
    partner = scenario.partner
    shown = shown_frames(episode, fps)
    page = Image.new("RGB", (WIDTH, TITLE + SCENE + CURVES), PAPER)
    page.paste(title_strip(episode, policy, WIDTH, TITLE))
    drawn = drawn_series(scenario.task.metrics)
    label = label_of(partner)
    curves = Curves(episode.trace, WIDTH, CURVES, partner=label, drawn=drawn)
    with closing(_scene(partner, drawn)) as scene:
        for frame in shown:
            view = _view(scene, episode, frame, WIDTH, SCENE, drawn)
            readout(view, episode, frame, partner, drawn)
            page.paste(view, (0, TITLE))
            page.paste(curves.at(frame), (0, TITLE + SCENE))
            yield np.asarray(page).copy()


def still_moments(episode: Episode, drawn: Sequence[DrawnSeries] = ()) -> list[int]:
    """Return the three frames that a still shows.

    They are the start, the human's highest point, and the largest error at a distance from both;
    for a failed lift, the start, the middle and the end.

    Raises
    ------
    InputError
        If the episode ended before its first frame.
    """
    shown = shown_frames(episode)
    if episode.failure is not None:
        return [shown[0], shown[len(shown) // 2], shown[-1]]
    highest = int(np.argmax(episode.trace.human_end))
    error = np.abs(shown_error(drawn, episode.trace))
    for moment in (shown[0], highest):
        error[max(0, moment - APART) : moment + APART] = 0.0
    return sorted((shown[0], highest, int(np.argmax(error))))


def still_picture(episode: Episode, scenario: Scenario, policy: str) -> Picture:
    """Return one picture of a lift: three moments side by side, and the curves under them.

    Raises
    ------
    InputError
        If the episode ended before its first frame.
    """
    partner = scenario.partner
    drawn = drawn_series(scenario.task.metrics)
    moments = still_moments(episode, drawn)
    size = (STILL_WIDTH, STILL_TITLE + STILL_SCENE + STILL_CURVES)
    page = Image.new("RGB", size, PAPER)
    page.paste(title_strip(episode, policy, STILL_WIDTH, STILL_TITLE))
    step = (STILL_WIDTH + GUTTER) // len(moments)
    with closing(_scene(partner, drawn)) as scene:
        for column, frame in enumerate(moments):
            view = _view(scene, episode, frame, step - GUTTER, STILL_SCENE, drawn)
            readout(view, episode, frame, partner, drawn)
            page.paste(view, (column * step, STILL_TITLE))
    curves = Curves(
        episode.trace,
        STILL_WIDTH,
        STILL_CURVES,
        partner=label_of(partner),
        drawn=drawn,
        scale=1.8 if not drawn else 1.6,
    )
    page.paste(curves.marked(moments), (0, STILL_TITLE + STILL_SCENE))
    return np.asarray(page).copy()


def film_episode(
    path: Path,
    episode: Episode,
    scenario: Scenario,
    policy: str,
    *,
    fps: float = FPS,
    drawn: Callable[[int], None] | None = None,
) -> None:
    """Write a lift as a film (``.gif``, ``.mp4``) or as one picture (``.png``).

    Parameters
    ----------
    path
        The file; its suffix determines the format.
    episode, scenario, policy, fps
        As in :func:`frames`.
    drawn
        Called with 1 after each picture, for a progress bar; there are
        ``len(shown_frames(episode, fps))`` in a film and one in a ``.png``.

    Raises
    ------
    InputError
        If the file cannot be written, or there is nothing to show.
    """
    check_film(path)
    shown_frames(episode, fps)
    if path.suffix == ".png":
        pictures = iter((still_picture(episode, scenario, policy),))
    else:
        pictures = frames(episode, scenario, policy, fps=fps)
    write(path, _counted(pictures, drawn), fps)


def _counted(pictures: Iterator[Picture], drawn: Callable[[int], None] | None) -> Iterator[Picture]:
    for picture in pictures:
        yield picture
        if drawn is not None:
            drawn(1)


def _scene(partner: str, drawn: Sequence[DrawnSeries]) -> Scene:
    """Return a scene with the additions of the task."""
    return Scene(
        partner,
        intended=intended_far_end(drawn) is not None,
        ball=ball_and_target(drawn) is not None,
    )


def _view(
    scene: Scene,
    episode: Episode,
    frame: int,
    width: int,
    height: int,
    drawn: Sequence[DrawnSeries],
) -> Image.Image:
    trace, goal, both = episode.trace, intended_far_end(drawn), ball_and_target(drawn)
    scene.pose(float(trace.human_end[frame]), float(trace.robot_end[frame]))
    if goal is not None:
        scene.intend(float(trace.target[frame]), float(trace.added[goal.name][frame]))
    if both is not None:
        ball, target = (float(trace.added[each.name][frame]) for each in both)
        scene.roll(ball, target)
    return Image.fromarray(scene.picture(width, height))
