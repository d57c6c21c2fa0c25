"""The installed packages whose compiled code decides bits: NumPy, and one of two PyBullets."""

import functools
import hashlib
from base64 import urlsafe_b64encode
from importlib.metadata import Distribution, distributions, version
from importlib.util import find_spec
from pathlib import Path
from typing import Final

from colift.base.errors import InputError

ENGINES: Final = ("pybullet", "pybullet-arm64")
"""PyBullet, and a fork of it for later versions of Python and for other systems than Linux."""

COMPILED: Final = frozenset({".so", ".pyd", ".dll", ".dylib"})
"""Suffixes of compiled code."""


def library_versions() -> dict[str, str]:
    """Return the versions of NumPy and PyBullet; that of the fork begins with its name."""
    name, number = engine().name, engine().version
    fork = "" if name == ENGINES[0] else f"{name} "
    return {"numpy": version("numpy"), "pybullet": f"{fork}{number}"}


@functools.cache
def engine() -> Distribution:
    """Return the distribution that ``import pybullet`` loads.

    Raises
    ------
    InputError
        If none is installed.
    """
    spec = find_spec("pybullet")
    found = [each for name in ENGINES for each in distributions(name=name)]
    if spec is None or spec.origin is None or not found:
        raise InputError(f"PyBullet is not installed: neither {' nor '.join(ENGINES)}")
    loaded = Path(spec.origin)
    # Both can be installed, one over the other: then it is the one whose file is still there.
    return found[0] if len(found) == 1 else next((d for d in found if _has(d, loaded)), found[0])


def _has(distribution: Distribution, file: Path) -> bool:
    """Return whether the installer's record has this file with its present content."""
    hashes = {
        each.hash.value
        for each in distribution.files or ()
        if each.hash and each.hash.mode == "sha256" and each.name == file.name
    }
    with file.open("rb") as content:
        digest = hashlib.file_digest(content, "sha256").digest()
    return urlsafe_b64encode(digest).decode().rstrip("=") in hashes


def binaries(*packages: Distribution) -> str:
    """Return a hash of the compiled parts of packages, from their installers' records."""
    records = [
        f"{path}={path.hash.value}"
        for package in packages
        for path in package.files or ()
        if path.hash and COMPILED.intersection(path.suffixes)
    ]
    return hashlib.sha256("\n".join(sorted(records)).encode()).hexdigest()[:16]
