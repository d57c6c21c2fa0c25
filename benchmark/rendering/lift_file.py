"""A lift as a file: film, picture, figure for print, or model in 3-D."""

from collections.abc import Callable
from pathlib import Path
from typing import Final

from colift.base.errors import InputError
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.figures import write_figure
from colift.benchmark.rendering.film import DEFAULT_LOOK, FPS, Look, film_episode, shown_frames
from colift.benchmark.rendering.gltf import check_model, write_model
from colift.benchmark.rendering.layout import PAGE, VECTOR, Layout
from colift.benchmark.rendering.lift_figure import lift_figure, lift_title
from colift.benchmark.rendering.writing import SUFFIXES, check_film

MODEL: Final = ".glb"
KNOWN: Final = tuple(dict.fromkeys((*SUFFIXES, *VECTOR, MODEL)))
"""Suffixes of the files of a lift."""


def check_lift_file(path: Path) -> None:
    """Refuse a file that cannot be written, before any work is done.

    Raises
    ------
    InputError
        If its suffix is unknown, its extra is not installed, or the folder of a film cannot be
        written to.
    """
    if path.suffix not in KNOWN:
        raise InputError(f"cannot write {path}: its suffix must be one of {', '.join(KNOWN)}")
    if path.suffix in SUFFIXES:
        check_film(path)
    if path.suffix == MODEL:
        check_model(path)


def write_lift(
    path: Path,
    episode: Episode,
    scenario: Scenario,
    policy: str,
    *,
    look: Look = DEFAULT_LOOK,
    layout: Layout | None = None,
    drawn: Callable[[int], None] | None = None,
) -> None:
    """Write a lift in the format that the suffix names.

    Parameters
    ----------
    path
        The file.
    episode, scenario, policy, look
        As for :func:`.film_episode`.
    layout
        Size of a figure; by default that of a page. A ``.png`` is a figure if this is given.
    drawn
        Called with 1 after each of :func:`pictures_in`, for a progress bar.

    Raises
    ------
    InputError
        As :func:`check_lift_file`, or if there is nothing to show.
    """
    check_lift_file(path)
    if path.suffix == MODEL:
        write_model(path, episode, scenario, policy)
    elif path.suffix in VECTOR or (path.suffix == ".png" and layout is not None):
        figure = lift_figure(episode, scenario, layout or PAGE, camera=look.camera)
        write_figure(path, figure, lift_title(episode, policy))
        if drawn is not None:
            drawn(1)
    else:
        film_episode(path, episode, scenario, policy, look=look, drawn=drawn)


def pictures_in(path: Path, episode: Episode, look: Look = DEFAULT_LOOK) -> int:
    """Return the number of pictures that are drawn for a file of a lift."""
    film = path.suffix in SUFFIXES and path.suffix != ".png"
    return len(shown_frames(episode, FPS / look.speed)) if film else 1
