import io

import numpy as np
import pytest
from colift.benchmark.figures.changes import LINES, file_change
from PIL import Image


def picture(pixels, kind="png"):
    """Return pictures as a file; all but the first are further frames."""
    first, *more = (Image.fromarray(np.asarray(each, np.uint8)) for each in pixels)
    buffer = io.BytesIO()
    first.save(buffer, kind, **({"save_all": True, "append_images": more} if more else {}))
    return buffer.getvalue()


def test_equal_content_is_no_change():
    assert file_change("a.txt", b"1\n", b"1\n") == ""
    assert file_change("a.txt", None, b"1\n") == "a.txt: new"


@pytest.mark.parametrize("name", ["a.txt", "a.svg"])
def test_lines_that_differ_are_shown(name):
    change = file_change(name, b"one\ntwo\nthree\n", b"one\n2\nthree\n")
    assert change == f"{name}: 2 lines differ\n  -two\n  +2"


def test_a_long_change_is_cut():
    many = "".join(f"{i}\n" for i in range(LINES + 5)).encode()
    change = file_change("a.txt", b"", many)
    assert change.splitlines()[0] == f"a.txt: {LINES + 5} lines differ"
    assert change.splitlines()[-1] == "  ... and 5 more lines"
    assert len(change.splitlines()) == LINES + 2


def test_the_pixels_that_differ_are_counted():
    white = np.full((10, 10, 3), 255)
    other = white.copy()
    other[0, :5] = 0
    old, new = picture([white]), picture([other])
    assert file_change("a.png", old, new) == "a.png: 5 % of the pixels differ"
    small = picture([white[:5]])
    assert file_change("a.png", old, small) == "a.png: another size"


@pytest.mark.parametrize("frames", [1, 3])
def test_a_film_with_another_number_of_frames_is_another_film(frames):
    shades = [np.full((8, 8), 60 * i) for i in range(4)]
    old, new = picture(shades[:2], "gif"), picture(shades[:frames], "gif")
    assert file_change("a.gif", old, new) == f"a.gif: {frames} pictures instead of 2"
