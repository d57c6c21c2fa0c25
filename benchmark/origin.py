"""What results come from besides policy and suite: this platform, and colift as it is here."""

import functools
import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Final

from ..agents.errors import InputError
from .bundle.fingerprint import fingerprint

ROOT: Final = Path(__file__).parents[1]
PACKAGES: Final = ("agents", "benchmark", "robots")
COLIFT: Final = "colift"


def origin() -> dict[str, str]:
    """Return whatever else can change a result, by name.

    It is the platform's :func:`.fingerprint`, and ``colift``: a hash of all our sources and data,
    since of these the fingerprint has only what simulates.
    """
    return {**fingerprint(), COLIFT: _sources()}


def platform(origin: Mapping[str, str]) -> dict[str, str]:
    """Return the part of an origin that is the platform's fingerprint."""
    return {name: value for name, value in origin.items() if name != COLIFT}


def compare(found: Mapping[str, str], wanted: Mapping[str, str], where: str, other: str) -> None:
    """Raise an InputError that names the first difference of two origins, if there is one.

    Parameters
    ----------
    found, wanted
        The origins; only what is in the second is compared.
    where, other
        Where they are, in words: ``on worker 3``, ``here``.
    """
    for name, value in wanted.items():
        if found.get(name) != value:
            raise InputError(
                f"results would depend on who computes them: {name} is {found.get(name)!r} {where} "
                f"and {value!r} {other}"
            )


@functools.cache
def _sources() -> str:
    sha = hashlib.sha256()
    for path in sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.*")):
        if path.suffix in (".py", ".json", ".urdf"):
            sha.update(f"{path.relative_to(ROOT)}\n".encode())
            sha.update(hashlib.sha256(path.read_bytes()).digest())
    return sha.hexdigest()[:16]
