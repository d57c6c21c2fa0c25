"""Writing of pictures to files: GIF, WebP, MP4 and PNG."""

import importlib
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, Final

import numpy as np
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.rendering.scene import Picture
from PIL import Image

COLOURS: Final = 256
"""Colours of a GIF, shared by its pictures, so that none flickers."""

WEBP: Final[Mapping[str, Any]] = {"quality": 80, "kmin": 999, "kmax": 1000}
"""Quality of a WebP, of 100, and its distance of whole pictures: it holds changes instead."""

SAMPLES: Final = 5
"""Number of pictures from which the colours of a film are chosen."""


def check_film(path: Path) -> None:
    """Refuse a file that cannot be written, before any work is done.

    Raises
    ------
    InputError
        If the suffix is unknown, its extra is not installed, or the folder cannot be written to.
    """
    _writer(path)
    if path.suffix == ".mp4":
        _ffmpeg()
    if not path.parent.is_dir():
        raise InputError(f"cannot write {path}: there is no folder {path.parent}")
    if path.is_dir():
        raise InputError(f"cannot write {path}: it is a folder")
    partial = _partial(path)
    try:
        partial.touch()
        partial.unlink()
    except OSError as error:
        raise InputError(f"cannot write to {path.parent}: {error.strerror}") from error


def write(path: Path, pictures: Iterable[Picture], fps: float, *, plays: int = 0) -> None:
    """Write pictures in the format that the suffix names: the whole file, or none.

    Parameters
    ----------
    path
        ``.gif``, ``.webp`` or ``.mp4``, a film; ``.png``, exactly one picture.
    pictures
        At least one, all of one shape ``(height, width, 3)``; height and width even for ``.mp4``.
    fps
        Pictures per second; a GIF rounds their duration to 10 ms, a WebP to 1 ms.
    plays
        Number of times that a GIF or WebP plays; 0 is without end.

    Raises
    ------
    InputError
        As :func:`check_film`, or if writing fails.
    ValueError
        If there is no picture, or more than one for a ``.png``.
    """
    check_film(path)
    partial = _partial(path)
    try:
        _writer(path)(partial, pictures, fps, plays)
        partial.replace(path)
    except OSError as error:
        raise InputError(f"cannot write {path}: {error.strerror or error}") from error
    finally:
        partial.unlink(missing_ok=True)


def _partial(path: Path) -> Path:
    return path.with_name(f".{path.stem}.partial{path.suffix}")


def _write_gif(path: Path, pictures: Iterable[Picture], fps: float, plays: int) -> None:
    images = _images(pictures)
    chosen = np.linspace(0, len(images) - 1, SAMPLES).round().astype(int)
    sample = Image.fromarray(np.concatenate([np.asarray(images[i]) for i in chosen]))
    palette = sample.quantize(COLOURS, method=Image.Quantize.MEDIANCUT)
    first, *rest = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    # The file has the number of repetitions; a film without it plays once.
    again: dict[str, Any] = {} if plays == 1 else {"loop": max(plays - 1, 0)}
    first.save(path, save_all=True, append_images=rest, duration=10 * round(100 / fps), **again)


def _write_webp(path: Path, pictures: Iterable[Picture], fps: float, plays: int) -> None:
    first, *rest = _images(pictures)
    first.save(
        path,
        save_all=True,
        append_images=rest,
        duration=round(1000 / fps),
        loop=plays,
        **WEBP,
    )


def _images(pictures: Iterable[Picture]) -> list[Image.Image]:
    images = [Image.fromarray(picture) for picture in pictures]
    if not images:
        raise ValueError("a film needs at least one picture")
    return images


def _write_mp4(path: Path, pictures: Iterable[Picture], fps: float, plays: int) -> None:
    frames = iter(pictures)
    first = next(frames, None)
    if first is None:
        raise ValueError("a film needs at least one picture")
    height, width, _ = first.shape
    film = _ffmpeg().write_frames(
        str(path),
        (width, height),
        fps=fps,
        macro_block_size=2,
        quality=None,
        output_params=["-crf", "20", "-movflags", "+faststart"],
        ffmpeg_log_level="error",
    )
    film.send(None)
    try:
        film.send(first)
        for frame in frames:
            film.send(frame)
    finally:
        film.close()


def _write_png(path: Path, pictures: Iterable[Picture], fps: float, plays: int) -> None:
    drawn = list(pictures)
    if len(drawn) != 1:
        raise ValueError(f"a .png is one picture, got {len(drawn)}")
    Image.fromarray(drawn[0]).save(path, optimize=True)


_WRITERS: Final = {
    ".gif": _write_gif,
    ".webp": _write_webp,
    ".mp4": _write_mp4,
    ".png": _write_png,
}

SUFFIXES: Final = tuple(_WRITERS)
"""Suffixes of the files to which pictures can be written."""


def _writer(path: Path) -> Callable[[Path, Iterable[Picture], float, int], None]:
    if path.suffix not in _WRITERS:
        known = ", ".join(_WRITERS)
        raise InputError(f"cannot write {path}: its suffix must be one of {known}")
    return _WRITERS[path.suffix]


def _ffmpeg() -> ModuleType:
    try:
        return importlib.import_module("imageio_ffmpeg")
    except ImportError as error:
        raise InputError(f"mp4 needs imageio-ffmpeg: {how_to_install('video')}") from error
