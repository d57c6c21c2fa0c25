"""A benchmark for human-robot cooperative lifting.

====================== ==========================================================================
name                   what it is
====================== ==========================================================================
:func:`evaluate`       scores a policy: an object, a class, a name, a file or a folder
:func:`load`           the same of a result bundle, from ``colift run --out``
:func:`inspect`        the reasons of a score: worst lifts, strengths and weaknesses
:func:`compare`        ranks policies, result bundles and evaluations on the same lifts
:func:`render`         draws one lift: a picture in a notebook, and files of every kind
:func:`list_policies`  names that :func:`evaluate` takes; also ``list_suites``, ``list_humans``
:func:`parallel_env`   the PettingZoo environment, both agents at once; :func:`env` takes turns
:func:`make`           the Gymnasium environment: the robot is the agent
``colift_v0``          the environment as a module, as PettingZoo's own are
``twin``               the twin as an environment: thousands of lifts at once, with gradients
====================== ==========================================================================

Importing colift loads none of its parts: each is loaded when it is first used. The import registers
``colift/Lift-v0`` with Gymnasium, whichever of the two is imported first.
"""

from __future__ import annotations

import importlib

from colift.registration import TYPE_CHECKING, register_with_gymnasium

if TYPE_CHECKING:
    from typing import Any, Final

    from colift import colift_v0, twin
    from colift.bundles import Inspection, inspect, load
    from colift.colift_v0 import env, parallel_env
    from colift.comparing import Comparison, compare
    from colift.evaluation import Evaluation, evaluate
    from colift.listing import list_humans, list_policies, list_suites
    from colift.registration import make
    from colift.rendering import RenderedLift, render

    __version__: str

__all__ = [
    "Comparison",
    "Evaluation",
    "Inspection",
    "RenderedLift",
    "__version__",
    "colift_v0",
    "compare",
    "env",
    "evaluate",
    "inspect",
    "list_humans",
    "list_policies",
    "list_suites",
    "load",
    "make",
    "parallel_env",
    "render",
    "twin",
]

_PLACES: Final = {
    "Comparison": "comparing",
    "compare": "comparing",
    "Evaluation": "evaluation",
    "Inspection": "bundles",
    "RenderedLift": "rendering",
    "env": "colift_v0",
    "evaluate": "evaluation",
    "inspect": "bundles",
    "list_humans": "listing",
    "list_policies": "listing",
    "list_suites": "listing",
    "load": "bundles",
    "make": "registration",
    "parallel_env": "colift_v0",
    "render": "rendering",
}
"""The module of each public name."""


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("colift")
    if name in ("colift_v0", "twin"):
        return importlib.import_module(f".{name}", __name__)
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f".{_PLACES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__


register_with_gymnasium()
