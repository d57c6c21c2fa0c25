"""One lift with several partners, side by side: scene, spirit level and error of each."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from colift.benchmark.episode.drawn import DrawnSeries, shown_error
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.cameras import CLOSE, SIDE
from colift.benchmark.rendering.caption import fitted, letters, millimetres
from colift.benchmark.rendering.film import DEFAULT_LOOK, FPS, Look, counted, shown_frames
from colift.benchmark.rendering.lift_scene import LiftScene
from colift.benchmark.rendering.scene import Picture
from colift.benchmark.rendering.style import AIM, FAINT, INK, LINE, PAPER, ROBOT
from colift.benchmark.rendering.ticks import round_step
from colift.benchmark.rendering.writing import write
from numpy.typing import NDArray
from PIL import Image, ImageDraw

WIDTH: Final = 320
TITLE, SCENE, LEVEL, CURVE, SCORE = 40, 236, 44, 92, 44
"""Width of a panel and heights of its strips [pixels]."""

GUTTER: Final = 4
MARGIN: Final = 14

STEPS: Final = 3
"""Lines of the error's axis, at most."""

HEADROOM: Final = 16
"""Room above the largest error [pixels]."""

AREA: Final = "#F3C9AE"
GLASS: Final = "#DDEEE7"

FINE: Final = 4
"""Pixels drawn for one pixel seen, in each direction, where the pen leaves edges jagged."""

Pen = ImageDraw.ImageDraw


@dataclass(frozen=True, kw_only=True)
class Partner:
    """A partner of the human in a lift."""

    name: str
    episode: Episode
    scenario: Scenario


def film_beside(
    path: Path,
    partners: Sequence[Partner],
    *,
    look: Look = DEFAULT_LOOK,
    drawn: Callable[[int], None] | None = None,
) -> None:
    """Write a lift with each of several partners as a film or as one picture.

    Parameters
    ----------
    path
        The file; its suffix determines the format, as in :func:`.film_episode`.
    partners
        As in :func:`frames_beside`.
    look
        Pace and camera; the one from the side is nearer here.
    drawn
        Called with 1 after each picture.

    Raises
    ------
    InputError
        If the file cannot be written, or there is nothing to show.
    """
    camera = CLOSE if look.camera == SIDE else look.camera
    if path.suffix == ".png":
        pictures = iter((still_beside(partners, camera=camera),))
    else:
        pictures = frames_beside(partners, fps=FPS / look.speed, camera=camera)
    write(path, counted(pictures, drawn), FPS, plays=look.plays)


def frames_beside(
    partners: Sequence[Partner], *, fps: float = FPS, camera: str = CLOSE
) -> Iterator[Picture]:
    """Yield the pictures of a film of one lift with each of several partners.

    Under each scene are a spirit level, the error so far, and its root mean square up to now; the
    last picture has the scores. A lift that ended early stands still from there on.

    Parameters
    ----------
    partners
        The partners, from left to right, in lifts of one behaviour, subject, seed and task.
    fps
        Pictures for each second of the lift.
    camera
        Name of the camera.

    Raises
    ------
    InputError
        As :func:`.shown_frames`.
    """
    shown = max((shown_frames(each.episode, fps) for each in partners), key=len)
    yield from _pictures(partners, [(frame, frame) for frame in shown], camera)


def still_beside(partners: Sequence[Partner], *, camera: str = CLOSE) -> Picture:
    """Return one picture of the lift: the moment of the largest error, and all errors and scores.

    Raises
    ------
    InputError
        As :func:`.shown_frames`.
    """
    last = max(shown_frames(each.episode)[-1] for each in partners)
    drawn = drawn_series(partners[0].scenario.task.metrics)
    errors = [np.abs(shown_error(drawn, each.episode.trace)) for each in partners]
    worst = max(errors, key=lambda error: float(error.max()))
    (picture,) = _pictures(partners, [(int(worst.argmax()), last)], camera)
    return picture


def _pictures(
    partners: Sequence[Partner], moments: Sequence[tuple[int, int]], camera: str
) -> Iterator[Picture]:
    """Yield a picture for each pair of frames: that of the scene, and the last of the curve."""
    drawn = drawn_series(partners[0].scenario.task.metrics)
    errors = [1000 * shown_error(drawn, each.episode.trace) for each in partners]
    reach = max(float(np.abs(error).max()) for error in errors)
    step = round_step(max(reach, 1.0), STEPS)
    panels = [
        _Panel(each, error, reach, step, drawn)
        for each, error in zip(partners, errors, strict=True)
    ]
    height = TITLE + SCENE + LEVEL + CURVE + SCORE
    page = Image.new("RGB", (len(panels) * (WIDTH + GUTTER) - GUTTER, height), PAPER)
    with ExitStack() as stack:
        scenes = [stack.enter_context(panel.scene(camera)) for panel in panels]
        for frame, until in moments:
            for column, (panel, scene) in enumerate(zip(panels, scenes, strict=True)):
                page.paste(panel.at(scene, frame, until), (column * (WIDTH + GUTTER), 0))
            yield np.asarray(page).copy()


class _Panel:
    """One partner's part of the picture.

    Parameters
    ----------
    partner
        The partner.
    error
        Its error in each frame [mm].
    reach, step
        Largest error of all partners, and distance of the lines of the axis [mm].
    drawn
        What the task shows.
    """

    def __init__(
        self,
        partner: Partner,
        error: NDArray[np.float64],
        reach: float,
        step: float,
        drawn: Sequence[DrawnSeries],
    ) -> None:
        self._partner, self._error, self._reach, self._step = partner, error, reach, step
        self._drawn = drawn

    def scene(self, camera: str) -> LiftScene:
        """Return the scene of the lift."""
        trace = self._partner.episode.trace
        return LiftScene(trace, self._partner.scenario.partner, self._drawn, camera)

    def at(self, scene: LiftScene, frame: int, until: int) -> Image.Image:
        """Return the panel at a frame, with the curve up to another; or as the lift ended."""
        last = len(self._error) - 1
        frame, until = min(frame, last), min(until, last)
        scene.show(frame)
        picture = Image.new("RGB", (WIDTH, TITLE + SCENE + LEVEL + CURVE + SCORE), PAPER)
        picture.paste(Image.fromarray(scene.scene.picture(WIDTH, SCENE)), (0, TITLE))
        picture.paste(self._level(float(self._error[frame])), (0, TITLE + SCENE))
        picture.paste(self._curve(until), (0, TITLE + SCENE + LEVEL))
        self._words(ImageDraw.Draw(picture), until, done=until == last)
        return picture

    def _words(self, pen: Pen, frame: int, *, done: bool) -> None:
        """Write the name, and the root mean square of the error up to a frame."""
        title, score = letters(20, bold=True), letters(24, bold=True)
        name = fitted(self._partner.name, title, WIDTH - 2 * MARGIN)
        pen.text((WIDTH / 2, TITLE / 2), name, fill=INK, font=title, anchor="mm")
        rmse = math.sqrt(float(np.mean(self._error[: frame + 1] ** 2)))
        value = f"{self._partner.episode.scores['rmse_mm'] if done else rmse:.1f} mm"
        y = TITLE + SCENE + LEVEL + CURVE + SCORE / 2
        pen.text((MARGIN, y), "error (RMSE)", fill=FAINT, font=letters(16), anchor="lm")
        pen.text((WIDTH - MARGIN, y), value, fill=ROBOT, font=score, anchor="rm")

    def _level(self, error: float) -> Image.Image:
        """Return a spirit level, whose bubble goes towards the robot if its end is too high."""
        width, height = FINE * WIDTH, FINE * LEVEL
        strip = Image.new("RGB", (width, height), PAPER)
        pen = ImageDraw.Draw(strip)
        left, top, half = FINE * MARGIN, FINE * 10, width / 2 - FINE * MARGIN
        box = (left, top, width - left, height - top)
        radius = (height - 2 * top) / 2
        pen.rounded_rectangle(box, radius, fill=GLASS, outline=FAINT, width=FINE)
        bubble = 1.5 * radius
        for side in (-1, 1):
            mark = width / 2 + side * (bubble + 3 * FINE)
            pen.line([(mark, top), (mark, height - top)], fill=FAINT, width=FINE)
        x = width / 2 - error / self._reach * (half - bubble - FINE) if self._reach else width / 2
        pen.ellipse(
            (x - bubble, top + 3 * FINE, x + bubble, height - top - 3 * FINE),
            fill=PAPER,
            outline=AIM,
            width=2 * FINE,
        )
        return strip.reduce(FINE)

    def _curve(self, frame: int) -> Image.Image:
        """Return the distance up to a frame, as an area."""
        width, height = FINE * WIDTH, FINE * CURVE
        strip = Image.new("RGB", (width, height), PAPER)
        pen = ImageDraw.Draw(strip)
        left, room = FINE * MARGIN, width - 2 * FINE * MARGIN
        count = max(len(self._error) - 1, 1)
        bottom = height - 2 * FINE

        def y(value: float) -> float:
            return bottom - value / max(self._reach, 1.0) * (bottom - FINE * HEADROOM)

        lines = [step * self._step for step in range(STEPS + 1) if step * self._step <= self._reach]
        for line in lines:
            ends = [(left, y(line)), (width - left, y(line))]
            pen.line(ends, fill=LINE if line else FAINT, width=FINE)
        points = [
            (left + room * index / count, y(abs(float(value))))
            for index, value in enumerate(self._error[: frame + 1])
        ]
        pen.polygon([(left, bottom), *points, (points[-1][0], bottom)], fill=AREA)
        pen.line(points, fill=ROBOT, width=2 * FINE)
        seen = strip.reduce(FINE)
        words = ImageDraw.Draw(seen)
        for line in lines[1:]:
            at = (MARGIN, y(line) / FINE - 1)
            words.text(at, millimetres(line), fill=FAINT, font=letters(12), anchor="ls")
        return seen
