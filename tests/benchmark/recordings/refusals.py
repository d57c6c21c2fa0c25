"""The words with which a file is refused."""

import pytest
from colift.base.errors import InputError
from colift.benchmark.recordings.taking import takes_of
from colift.benchmark.recordings.wishes import Wishes


def refusal(path, **wishes):
    """Return the error of reading the lifts of a file: one line, which begins with the file."""
    with pytest.raises(InputError) as caught:
        takes_of(path, Wishes(**wishes))
    assert str(caught.value).startswith(str(path))
    assert str(caught.value).isprintable()
    return str(caught.value)
