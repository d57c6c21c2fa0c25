"""A finished lift as a film, or as one picture."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from colift.agents.agent import FRAME
from colift.base.errors import InputError
from colift.benchmark.episode.drawn import DrawnSeries, drawn_hurdles, shown_error
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.bodies import label_of
from colift.benchmark.rendering.cameras import SIDE, check_camera
from colift.benchmark.rendering.caption import readout, title_strip
from colift.benchmark.rendering.chart import Chart
from colift.benchmark.rendering.curves import Curves
from colift.benchmark.rendering.lift_scene import LiftScene
from colift.benchmark.rendering.scene import Picture
from colift.benchmark.rendering.style import PAPER
from colift.benchmark.rendering.writing import check_film, write
from PIL import Image

FPS: Final = 12.5
"""Pictures per second: 80 ms each, which a GIF can represent exactly."""

WIDTH: Final = 640
TITLE, SCENE, CURVES = 36, 360, 204
"""Heights of a film's three strips [pixels]; 600 together."""

PANEL: Final = 96
"""Height that each further axis of the chart adds to a film [pixels]."""

STILL_WIDTH: Final = 1290
STILL_TITLE, STILL_SCENE, STILL_CURVES, STILL_PANEL = 64, 426, 400, 170
GUTTER: Final = 6
"""Gap between two scenes of a still [pixels]."""

MOMENTS: Final = 3
"""Scenes of a still."""

APART: Final = 60
"""Least distance of a still's moments [frames], in lifts that are long enough."""


SPEEDS: Final = (0.125, 12.5)
"""Slowest and fastest film, relative to the lift."""


@dataclass(frozen=True, kw_only=True)
class Look:
    """The view and the pace of pictures.

    Raises
    ------
    InputError
        If the camera is unknown, or a number is out of range.
    """

    camera: str = SIDE
    """Name of the camera; see :data:`.CAMERAS`."""
    speed: float = 1.0
    """Speed of a film, relative to the lift."""
    plays: int = 0
    """Number of times that a GIF or WebP plays; 0 is without end."""

    def __post_init__(self) -> None:
        """Check the values."""
        check_camera(self.camera)
        slowest, fastest = SPEEDS
        if not slowest <= self.speed <= fastest:
            raise InputError(f"speed must be within {slowest} to {fastest}, got {self.speed}")
        if self.plays < 0:
            raise InputError(f"plays must not be negative, got {self.plays}")


DEFAULT_LOOK: Final = Look()


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
    episode: Episode,
    scenario: Scenario,
    policy: str,
    *,
    fps: float = FPS,
    look: Look = DEFAULT_LOOK,
) -> Iterator[Picture]:
    """Yield the pictures of a film: title, scene, curves with a moving cursor.

    Parameters
    ----------
    episode
        A finished episode.
    scenario
        Its scenario.
    policy
        Name of the policy, for the title.
    fps
        Pictures for each second of the film.
    look
        Camera and speed.

    Raises
    ------
    InputError
        As :func:`shown_frames`.
    """
    partner = scenario.partner
    shown = shown_frames(episode, fps / look.speed)
    drawn = drawn_series(scenario.task.metrics)
    chart = Chart(episode.trace, partner=label_of(partner), drawn=drawn)
    curves = Curves(chart, WIDTH, CURVES + PANEL * (chart.panels - 1))
    page = Image.new("RGB", (WIDTH, TITLE + SCENE + curves.height), PAPER)
    page.paste(title_strip(episode, policy, WIDTH, TITLE))
    with LiftScene(episode.trace, partner, drawn, look.camera) as lift:
        for frame in shown:
            page.paste(_view(lift, episode, frame, (WIDTH, SCENE), drawn), (0, TITLE))
            page.paste(curves.at(frame), (0, TITLE + SCENE))
            yield np.asarray(page).copy()


def still_moments(episode: Episode, drawn: Sequence[DrawnSeries] = ()) -> list[int]:
    """Return the three frames that a still shows.

    They are the start, the human's highest point, and the largest error at a distance from both. In
    a lift with hurdles, the middle of the stay that is nearest to each takes the place of the
    highest point, and with two of the largest error; a failed lift shows start, middle and end.

    Raises
    ------
    InputError
        If the episode ended before its first frame.
    """
    shown = shown_frames(episode)
    if episode.failure is not None:
        return [shown[0], shown[len(shown) // 2], shown[-1]]
    stays = [
        each.nearest + each.stay // 2
        for each in drawn_hurdles(drawn, episode.trace)
        if each.nearest is not None
    ]
    highest = int(np.argmax(episode.trace.human_end))
    moments = [shown[0], *(stays[:2] or [highest])]
    if len(moments) < MOMENTS:
        error = np.abs(shown_error(drawn, episode.trace))
        for moment in moments:
            error[max(0, moment - APART) : moment + APART] = 0.0
        moments.append(int(np.argmax(error)))
    return sorted(moments)


def still_picture(
    episode: Episode, scenario: Scenario, policy: str, *, look: Look = DEFAULT_LOOK
) -> Picture:
    """Return one picture of a lift: three moments side by side, and the curves under them.

    Raises
    ------
    InputError
        If the episode ended before its first frame.
    """
    partner = scenario.partner
    drawn = drawn_series(scenario.task.metrics)
    moments = still_moments(episode, drawn)
    chart = Chart(episode.trace, partner=label_of(partner), drawn=drawn)
    height = STILL_CURVES + STILL_PANEL * (chart.panels - 1)
    curves = Curves(chart, STILL_WIDTH, height, scale=1.8 if not drawn else 1.6)
    page = Image.new("RGB", (STILL_WIDTH, STILL_TITLE + STILL_SCENE + height), PAPER)
    page.paste(title_strip(episode, policy, STILL_WIDTH, STILL_TITLE))
    step = (STILL_WIDTH + GUTTER) // len(moments)
    with LiftScene(episode.trace, partner, drawn, look.camera) as lift:
        for column, frame in enumerate(moments):
            view = _view(lift, episode, frame, (step - GUTTER, STILL_SCENE), drawn)
            page.paste(view, (column * step, STILL_TITLE))
    page.paste(curves.marked(moments), (0, STILL_TITLE + STILL_SCENE))
    return np.asarray(page).copy()


def film_episode(
    path: Path,
    episode: Episode,
    scenario: Scenario,
    policy: str,
    *,
    fps: float = FPS,
    look: Look = DEFAULT_LOOK,
    drawn: Callable[[int], None] | None = None,
) -> None:
    """Write a lift as a film (``.gif``, ``.webp``, ``.mp4``) or as one picture (``.png``).

    Parameters
    ----------
    path
        The file; its suffix determines the format.
    episode, scenario, policy, fps, look
        As in :func:`frames`.
    drawn
        Called with 1 after each picture, for a progress bar; there are
        ``len(shown_frames(episode, fps / look.speed))`` in a film and one in a ``.png``.

    Raises
    ------
    InputError
        If the file cannot be written, or there is nothing to show.
    """
    check_film(path)
    shown_frames(episode, fps / look.speed)
    if path.suffix == ".png":
        pictures = iter((still_picture(episode, scenario, policy, look=look),))
    else:
        pictures = frames(episode, scenario, policy, fps=fps, look=look)
    write(path, counted(pictures, drawn), fps, plays=look.plays)


def counted(pictures: Iterator[Picture], drawn: Callable[[int], None] | None) -> Iterator[Picture]:
    """Yield pictures, and tell after each that it is drawn."""
    for picture in pictures:
        yield picture
        if drawn is not None:
            drawn(1)


def _view(
    lift: LiftScene,
    episode: Episode,
    frame: int,
    size: tuple[int, int],
    drawn: Sequence[DrawnSeries],
) -> Image.Image:
    """Return the scene of a frame, with its numbers."""
    lift.show(frame)
    view = Image.fromarray(lift.scene.picture(*size))
    readout(view, episode, frame, lift.partner, drawn)
    return view
