"""The render modes of environments."""

from typing import Final

from colift.base.errors import InputError

RENDER_MODES: Final = (None, "human", "rgb_array")


def check_render_mode(mode: str | None) -> None:
    """Refuse an unknown render mode.

    Raises
    ------
    InputError
        If the mode is not one of ``RENDER_MODES``.
    """
    if mode not in RENDER_MODES:
        raise InputError(f"render_mode must be None, 'human' or 'rgb_array', got {mode!r}")
