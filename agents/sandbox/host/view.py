"""The visible files of a sandboxed policy: a Python with its packages, and the policy's folder.

Of colift only :data:`.SHOWN` is visible, without the humans: no suite, scenario, plan or seed.
"""

import os
import sys
import sysconfig
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import msgpack
import numpy as np
from colift.agents.sandbox.protocol import AGENTS, SHOWN

_SYSTEM: Final = (
    *("/usr/lib", "/usr/lib64", "/usr/lib32", "/lib", "/lib64", "/lib32"),
    *("/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d"),
)


@dataclass(frozen=True, kw_only=True)
class View:
    """The visible paths: read-only, and at the same place as outside."""

    python: Path
    """The interpreter."""
    packages: tuple[Path, ...]
    """Folders with installed packages."""
    readable: tuple[Path, ...]
    """Files and directories; an outer one comes before those inside it."""
    hidden: tuple[Path, ...]
    """Directories inside those that are covered, except :data:`.SHOWN` in one of them."""

    def visible(self) -> Iterator[Path]:
        """Yield the readable paths without the hidden ones, as few as possible."""
        found = list(self.readable)
        for path in found:
            if path in self.hidden:
                continue  # A hidden path covers everything within it.
            if any(path in each.parents for each in self.hidden):
                found += sorted(path.iterdir())
            else:
                yield path

    def outermost(self) -> Iterator[Path]:
        """Yield the readable paths that are not within another."""
        for path in self.readable:
            if not any(other in path.parents for other in self.readable):
                yield path


def view(folder: Path | None) -> View:
    """Return the view of a policy with a folder (absolute, resolved), or with none."""
    # The packages of this environment, and the folders from which the needed ones really come.
    named = [Path(sysconfig.get_path(name)) for name in ("purelib", "platlib")]
    used = [Path(str(module.__file__)).parents[1] for module in (np, msgpack)]
    packages = tuple(each for each in _distinct([*named, *used]) if each.is_dir())
    python = Path(os.path.realpath(getattr(sys, "_base_executable", "") or sys.executable))
    standard = [Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "platstdlib")]
    library = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("LDLIBRARY"))
    shared = [library.resolve()] if library.is_file() else []
    system = [Path(each) for each in _SYSTEM if Path(each).exists()]
    own = [*SHOWN, *([folder] if folder else [])]
    sites = [*packages, *(each / "site-packages" for each in standard)]
    hidden = [*(each / "colift" for each in sites), AGENTS / "humans"]
    return View(
        python=python,
        packages=packages,
        readable=_distinct([*system, *standard, python, *shared, *packages, *own]),
        hidden=tuple(each for each in _distinct(hidden) if each.is_dir()),
    )


def _distinct(paths: list[Path]) -> tuple[Path, ...]:
    return tuple(dict.fromkeys(each if each.is_symlink() else each.resolve() for each in paths))


_KERNELS: Final = (
    *("OPENBLAS_CORETYPE", "OPENBLAS_BLOCK_FACTOR", "OPENBLAS_L2_SIZE"),
    *("MKL_CBWR", "MKL_DEBUG_CPU_TYPE", "MKL_ENABLE_INSTRUCTIONS"),
    *("BLIS_ARCH_TYPE", "BLIS_MODEL_TYPE"),
    *("NPY_DISABLE_CPU_FEATURES", "NPY_ENABLE_CPU_FEATURES", "GLIBC_TUNABLES"),
)
"""Variables by which linear algebra, NumPy and the C library choose their code, and with it a
result's last bits."""

_THREADS: Final = ("OMP", "OPENBLAS", "MKL", "BLIS", "NUMEXPR", "VECLIB_MAXIMUM")


def environment() -> dict[str, str]:
    """Return the environment variables of a sandboxed process.

    They are the same everywhere, except those of this process that choose numerical code, so that a
    policy computes the same bits inside and outside.
    """
    return {
        **{name: os.environ[name] for name in _KERNELS if name in os.environ},
        "HOME": "/tmp",
        "TMPDIR": "/tmp",
        "LC_ALL": "C.UTF-8",
        "MALLOC_ARENA_MAX": "2",
        "PATH": "/usr/bin:/bin",
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONHASHSEED": "0",
        "TZ": "UTC",
        **{f"{each}_NUM_THREADS": "1" for each in _THREADS},
    }
