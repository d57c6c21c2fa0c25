"""The words of a picture: its lift, and the present heights of the ends."""

from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Final

import matplotlib
from colift.agents.agent import FRAME
from colift.benchmark.episode.drawn import (
    DrawnHurdle,
    DrawnSeries,
    ball_and_target,
    drawn_hurdles,
    intended_far_end,
    shown_error,
)
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.trace import Trace
from colift.benchmark.rendering.bodies import PERSON, label_of, shown_body
from colift.benchmark.rendering.style import COLOURS, FAINT, HUMAN, INK, PAPER, ROBOT
from PIL import Image, ImageDraw, ImageFont

VALUE: Final = 84
"""Room for a value beside its label [pixels]."""


@cache
def letters(size: int, *, bold: bool = False) -> ImageFont.FreeTypeFont:
    """Return DejaVu Sans, which comes with matplotlib, in a size [pixels]."""
    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(Path(matplotlib.get_data_path(), "fonts", "ttf", name), size)


def title_strip(episode: Episode, policy: str, width: int, height: int) -> Image.Image:
    """Return a strip with the lift, its RMSE [mm] and whether it failed."""
    picture = Image.new("RGB", (width, height), PAPER)
    pen = ImageDraw.Draw(picture)
    size, middle = round(0.40 * height), height / 2
    bold, plain = letters(size, bold=True), letters(size)
    score = f"RMSE {episode.scores['rmse_mm']:.1f} mm"
    if episode.failure is not None:
        score = f"failed, {score}"
    right = width - size
    pen.text((right, middle), score, fill=INK, font=bold, anchor="rm")
    right -= round(pen.textlength(score, font=bold)) + size
    name = fitted(policy, bold, right / 2)
    pen.text((size, middle), name, fill=INK, font=bold, anchor="lm")
    left = size + bold.getlength(name)
    trial = [episode.trial] if episode.trial else []
    parts = ["", episode.behaviour, episode.subject, *trial, f"seed {episode.seed}"]
    words = fitted("  ·  ".join(parts), plain, right - left)
    pen.text((left, middle), words, fill=FAINT, font=plain, anchor="lm")
    return picture


def fitted(text: str, font: ImageFont.FreeTypeFont, room: float) -> str:
    """Return the text, shortened to fit into ``room`` [pixels]."""
    if font.getlength(text) <= room:
        return text
    while text and font.getlength(f"{text}…") > room:
        text = text[:-1]
    return f"{text}…"


def readout(
    picture: Image.Image,
    episode: Episode,
    frame: int,
    partner: str,
    drawn: Sequence[DrawnSeries] = (),
) -> None:
    """Write a frame's time, heights, places and errors [mm] into a scene.

    They are in the upper left above a NAO, and in the middle between two people. The last frame of
    a failed episode states the reason.
    """
    trace = episode.trace
    human, robot = 1000 * float(trace.human_end[frame]), 1000 * float(trace.robot_end[frame])
    hurdles = drawn_hurdles(drawn, trace)
    series = [each for each in drawn if each.stay is None]
    level = intended_far_end(drawn) is None and ball_and_target(drawn) is None
    error = 1000 * abs(float(shown_error(drawn, trace)[frame]))
    rows = [
        ("time", f"{(frame + 1) * FRAME:.2f} s", FAINT, False),
        ("human's end", millimetres(human), HUMAN, False),
        (f"{label_of(partner)}'s end", millimetres(robot), ROBOT, False),
        *((each.label, millimetres(_at(trace, each, frame)), INK, False) for each in series),
        *((each.label, _state(each, frame), COLOURS[each.where], False) for each in hurdles),
        ("difference" if level else "error", millimetres(error), INK, not hurdles),
    ]
    pen = ImageDraw.Draw(picture)
    size, line, wide = 15, 20, 192 if not drawn else 216
    labels = max(letters(size).getlength(label) for label, *_ in rows)
    values = max(letters(size).getlength(value) for _, value, *_ in rows)
    wide = max(wide, round(labels) + max(VALUE, round(values) + size))
    top, margin = 10, 18
    left = (picture.width - wide) // 2 if shown_body(partner) == PERSON else margin
    for row, (label, value, colour, bold) in enumerate(rows):
        y, font = top + row * line, letters(size, bold=bold)
        pen.text((left, y), label, fill=colour, font=font)
        pen.text((left + wide, y), value, fill=colour, font=font, anchor="ra")
    if episode.failure is not None and frame == len(trace.human_end) - 1:
        pen.rectangle((0, picture.height - line, picture.width, picture.height), fill=INK)
        font = letters(13)
        reason = fitted(" ".join(episode.failure.split()), font, picture.width - 2 * margin)
        place = (picture.width / 2, picture.height - line / 2)
        pen.text(place, reason, fill=PAPER, font=font, anchor="mm")


def _at(trace: Trace, drawn: DrawnSeries, frame: int) -> float:
    """Return an added series at a frame [mm]."""
    return 1000 * float(trace.added[drawn.name][frame])


def _state(hurdle: DrawnHurdle, frame: int) -> str:
    """Return when a hurdle opens, its height while it is open, and then the distance missed."""
    if frame < hurdle.start:
        return f"in {(hurdle.start - frame) * FRAME:.1f} s"
    if frame < hurdle.stop:
        return millimetres(1000 * hurdle.height)
    return "missed" if hurdle.missed is None else f"off {millimetres(1000 * hurdle.missed)}"


def millimetres(height: float) -> str:
    """Return a height in whole millimetres, without a minus sign before zero."""
    return f"{round(height)} mm".replace("-", "\N{MINUS SIGN}")
