"""The registered policies that play a suite."""

from importlib.metadata import EntryPoint

from colift.base.registry import made_for, own_policies, playing
from colift.benchmark.suites.suite import Suite


def playing_on(suite: Suite) -> dict[str, EntryPoint]:
    """Return the entry points of all policies for a suite; see :func:`.playing`."""
    return playing(_task(suite), sessions=suite.session > 0)


def own_playing_on(suite: Suite) -> tuple[str, ...]:
    """Return the names of colift's own policies for a suite; see :func:`.own_policies`."""
    return own_policies(_task(suite), sessions=suite.session > 0)


def made_for_suite(suite: Suite) -> tuple[str, ...]:
    """Return the names of colift's own policies made for a suite; see :func:`.made_for`."""
    return made_for(_task(suite), sessions=suite.session > 0)


def _task(suite: Suite) -> str:
    return suite.scenarios[0].task.name
