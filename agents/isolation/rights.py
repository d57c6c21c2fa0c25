"""The rights of a policy's process: it gives up, for good, all that a policy does not need."""

import resource
from pathlib import Path
from typing import Final

from . import landlock, linux, seccomp
from .walls import FRESH, Walls

NOBODY: Final = 65534

_DEVICES: Final = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")


def give_up(walls: Walls) -> None:
    """Leave this process the rights that the walls allow, and its limits.

    Raises
    ------
    OSError
        If the kernel refuses.
    """
    if walls.namespaces == "root":
        linux.become(NOBODY, NOBODY)
        # It is nobody, but reads what only the superuser may of what it sees: folders are private.
        # The capability holds in its own user namespace only.
        linux.drop_capabilities(1 << linux.CAP_DAC_READ_SEARCH)
    else:
        linux.drop_capabilities()
    linux.forbid_new_privileges()
    linux.hide(False)
    if walls.landlock:
        landlock.restrict(_rules(walls))
    if walls.seccomp:
        seccomp.install()
    _set_limits(walls)


def _rules(walls: Walls) -> list[tuple[Path, int]]:
    """Return what Landlock allows."""
    shown = (Path("/"),) if walls.mounted else walls.readable
    rules = [(path, landlock.READ) for path in shown]
    rules += [(Path(each), landlock.READ_FILE | landlock.WRITE_FILE) for each in _DEVICES]
    rules += [(Path("/proc"), landlock.READ)] if walls.namespaces else []
    writable = [Path(each) for each in FRESH] if walls.namespaces else []
    writable += [walls.scratch] if walls.scratch else []
    return rules + [(each, landlock.ALL & ~landlock.IOCTL) for each in writable]


def _set_limits(walls: Walls) -> None:
    limits = walls.limits
    values = {
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_FSIZE: limits["file_size"],
        resource.RLIMIT_NOFILE: limits["files"],
        resource.RLIMIT_CPU: limits["cpu_seconds"],
        resource.RLIMIT_DATA: limits["memory"],
        # Addresses that are only reserved, as by every thread, are not used.
        resource.RLIMIT_AS: 4 * limits["memory"],
    }
    if walls.namespaces:
        # Elsewhere the kernel would count all processes of the user, not only the policy's.
        values[resource.RLIMIT_NPROC] = limits["processes"]
    for kind, value in values.items():
        hard = resource.getrlimit(kind)[1]
        value = value if hard == resource.RLIM_INFINITY else min(value, hard)
        resource.setrlimit(kind, (value, value))
