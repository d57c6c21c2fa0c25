"""The physics engine, which some Pythons do without."""

from importlib.util import find_spec
from typing import Final

from colift.base.errors import InputError

ENGINE: Final = "pybullet"
"""Its module."""

NO_ENGINE: Final = (
    "lifts in the engine need PyBullet, which is not installed: it has wheels for Python 3.11 to "
    "3.13 (pip install pybullet, or pybullet-arm64); the twin needs none"
)
"""What to do where it is missing."""


def require_engine() -> None:
    """Refuse to go on where the engine is not installed.

    Raises
    ------
    InputError
        If it is not.
    """
    if find_spec(ENGINE) is None:
        raise InputError(NO_ENGINE)
