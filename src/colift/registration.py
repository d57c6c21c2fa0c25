"""Registration of the environments with Gymnasium, and the environment by one call."""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # As in ``typing``, which takes longer to import than all of this.

if TYPE_CHECKING:
    from collections.abc import Sequence
    from importlib.machinery import ModuleSpec
    from types import ModuleType
    from typing import Any, Final

    from gymnasium import Env
    from gymnasium.vector import VectorEnv

GYMNASIUM: Final = "gymnasium"
ID: Final = "colift/Lift-v0"
TWIN_ID: Final = "colift/Lift-twin-v0"


def register_with_gymnasium() -> None:
    """Register the environment now if Gymnasium is loaded, else as soon as it is.

    Gymnasium reads no entry points since 1.0, and takes some tenths of a second to import.
    """
    loaded = sys.modules.get(GYMNASIUM)
    if loaded is not None:
        _register(loaded)
    else:
        sys.meta_path.insert(0, _Awaited())


class _Awaited:
    """A finder that waits for the import of Gymnasium, and then registers the environments.

    It finds the module by the other finders. The abstract base class of finders would take most of
    the time in which colift is imported.
    """

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name != GYMNASIUM:
            return None
        sys.meta_path.remove(self)
        from importlib.util import find_spec

        spec = find_spec(name)
        if spec is None or spec.loader is None:
            sys.meta_path.insert(0, self)
            return spec
        execute = spec.loader.exec_module

        def executed(module: ModuleType) -> None:
            try:
                execute(module)
            except BaseException:
                sys.meta_path.insert(0, self)  # For another attempt to import it.
                raise
            _register(module)

        spec.loader.exec_module = executed  # type: ignore[method-assign]
        return spec


def _register(gymnasium: ModuleType) -> None:
    gymnasium.register(id=ID, entry_point="colift.benchmark.environment.single:RobotEnv")
    gymnasium.register(id=TWIN_ID, vector_entry_point=_twin)


def _twin(**settings: Any) -> VectorEnv[Any, Any, Any]:
    """Return the vector environment on the twin, which needs the extra ``train``."""
    from colift.benchmark.twin.libraries import require_jax

    require_jax()
    from colift.benchmark.twin_environment.vector import TwinVectorEnv

    return TwinVectorEnv(**settings)


def make(
    behaviour: str = "smooth",
    subject: str = "S1",
    *,
    render_mode: str | None = None,
    **settings: Any,
) -> Env[Any, Any]:
    """Return ``gymnasium.make("colift/Lift-v0", ...)``: the robot is the agent.

    Parameters
    ----------
    behaviour
        Name of the human's behaviour; see :func:`colift.list_humans`. ``"any"`` draws one at each
        reset.
    subject
        Name of the human: ``"S1"`` to ``"S5"``, or ``"draw-N"``. ``"draw"`` draws a new person at
        each reset.
    render_mode
        ``None``, ``"rgb_array"`` or ``"human"``.
    settings
        ``control_period`` and ``latency`` [s], ``reward`` (``"task"`` or ``"score"``), ``task``
        (``"level"`` or another one of ``colift list``), and the arguments of ``gymnasium.make``
        itself.

    Raises
    ------
    InputError
        If a name is unknown (the message lists the known ones) or a time is out of range.
    """
    import gymnasium

    return gymnasium.make(
        ID, behaviour=behaviour, subject=subject, render_mode=render_mode, **settings
    )
