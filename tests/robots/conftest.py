from collections.abc import Iterator

import pybullet
import pytest


@pytest.fixture
def client() -> Iterator[int]:
    """Return the number of an empty physics world without a window."""
    number: int = pybullet.connect(pybullet.DIRECT)
    yield number
    pybullet.disconnect(number)
