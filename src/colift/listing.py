"""Lists of the available policies, suites and behaviours."""

from colift.base.registry import HUMANS, POLICIES, entries, playing, suite_names


def list_policies(task: str | None = None) -> list[str]:
    """Return the names of the robot policies, colift's and those of other packages.

    Parameters
    ----------
    task
        Name of a task, such as ``"intent"``: return those that play it, which are the policies for
        any task and those for this one alone. By default, all.
    """
    return list(entries(POLICIES) if task is None else playing(task))


def list_humans() -> list[str]:
    """Return the names of the human behaviours: the scenarios of :func:`.make`."""
    return list(entries(HUMANS))


def list_suites() -> list[str]:
    """Return the names of the suites that :func:`.evaluate` takes."""
    return list(suite_names())
