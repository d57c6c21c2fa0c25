"""The files of a comparison."""

import json
import os
from pathlib import Path

from ...agents.errors import InputError
from .comparison import Comparison
from .content import comparison_csv, comparison_json
from .html import html_page
from .picture import comparison_figure, png
from .words import picture_title


def check_target(folder: Path) -> None:
    """Make the folder if need be, or refuse it, before any work is done.

    Raises
    ------
    InputError
        If it is a file, or cannot be made or written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"--out {folder} cannot be a folder: {error.strerror}") from error
    if not os.access(folder, os.W_OK):
        raise InputError(f"cannot write to --out {folder}: it is not writable")


def write_comparison(folder: Path, comparison: Comparison) -> None:
    """Write ``compare.json``, ``compare.csv``, ``compare.png`` and ``compare.html`` into a folder.

    Equal comparisons give equal files, up to the step times.

    Raises
    ------
    InputError
        As :func:`check_target`.
    """
    check_target(folder)
    figure = comparison_figure(comparison, title=picture_title(comparison))
    content = json.dumps(comparison_json(comparison), indent=2, allow_nan=False) + "\n"
    (folder / "compare.png").write_bytes(png(figure))
    (folder / "compare.json").write_text(content, encoding="utf-8")
    (folder / "compare.csv").write_text(comparison_csv(comparison), encoding="utf-8")
    (folder / "compare.html").write_text(html_page(comparison), encoding="utf-8")
