"""Lists of the available policies, suites and behaviours."""

from .agents.registry import HUMANS, POLICIES, SUITES, entries


def list_policies() -> list[str]:
    """Return the names of the robot policies, colift's and those of other packages."""
    return list(entries(POLICIES))


def list_humans() -> list[str]:
    """Return the names of the human behaviours: the scenarios of :func:`.make`."""
    return list(entries(HUMANS))


def list_suites() -> list[str]:
    """Return the names of the suites that :func:`.evaluate` takes."""
    return list(entries(SUITES))
