"""The origin of a figure: digests of all on which its numbers depend."""

import functools
import hashlib
import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.base.identity import code_hash
from colift.base.registry import own_policies
from colift.benchmark.figures.registry import ALL, RecordedFigure
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import LEVEL

COLIFT: Final = __name__.partition(".")[0]

SCRIPT: Final = re.compile(r"\bexamples/[\w/]+\.py\b")
"""A script of the clone in a command."""

Origin = dict[str, str]
"""Digests, by name: ``suite standard-v1``, ``policy blend``, ``command``,
``script examples/plot_plans.py``."""


def origin_of(figure: RecordedFigure, root: Path) -> Origin:
    """Return the origin of a figure of the clone in the folder ``root``, as the code is now.

    The command is part of it, and so are the scripts of ``examples`` that it names. A figure of
    the machine depends on nothing else that has a digest.

    Raises
    ------
    InputError
        If a suite, a policy, a definition or a script does not exist.
    """
    policies = own_policies(LEVEL.name) if ALL in figure.policies else figure.policies
    return {
        "command": figure.command,
        **{f"suite {name}": _suite(name) for name in figure.suites},
        **{f"policy {name}": _policy(name) for name in policies},
        **{f"code {place}": _code(place) for place in figure.code},
        **{f"script {name}": _script(root, name) for name in SCRIPT.findall(figure.command)},
    }


@functools.cache
def _suite(name: str) -> str:
    return make_suite(name).digest


@functools.cache
def _policy(name: str) -> str:
    return PolicySpec(text=name).digest()


@functools.cache
def _code(place: str) -> str:
    module, _, name = place.partition(":")
    try:
        found: Callable[..., Any] = getattr(importlib.import_module(f"{COLIFT}.{module}"), name)
    except (ImportError, AttributeError):
        raise InputError(f"figures: there is no {name!r} in {COLIFT}.{module}") from None
    return code_hash(found)


def _script(root: Path, name: str) -> str:
    path = root / name
    if not path.is_file():
        raise InputError(f"figures: there is no {name!r} in {root}")
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]
