"""Provenance of results besides policy and suite: the platform, and the code of colift."""

import functools
import hashlib
import math
import platform
import re
import struct
from collections.abc import Mapping
from importlib.metadata import distribution
from pathlib import Path
from typing import Final

import numpy as np
from colift.agents.sandbox.guest import forkserver
from colift.base.errors import InputError
from colift.base.identity import Root, code_hash
from colift.benchmark.episode.identity import simulation_hash, stated
from colift.benchmark.execution.batches import Batch
from colift.benchmark.execution.distributions import binaries, engine, library_versions
from colift.benchmark.execution.packaging import PackagedPolicy
from threadpoolctl import threadpool_info

POLICIES_ONLY: Final = ("vector_extensions", "linear_algebra")
"""Entries on which only policies depend, but no bit of a simulation or score."""


@functools.cache
def _fingerprint() -> tuple[tuple[str, str], ...]:
    simd = np.show_config(mode="dicts")["SIMD Extensions"]
    return (
        ("machine", f"{platform.system()} {platform.machine()}"),
        ("processor", _processor()),
        # NumPy chooses its functions by these, and their results differ in the last bit.
        ("vector_extensions", " ".join([*simd["baseline"], *simd.get("found", ())])),
        ("linear_algebra", _linear_algebra()),
        ("libc", " ".join(platform.libc_ver())),
        ("libm", _libm()),
        ("python", f"{platform.python_implementation()} {platform.python_version()}"),
        *library_versions().items(),
        ("binaries", binaries(distribution("numpy"), engine())),
        ("simulation", simulation_hash()),
    )


def fingerprint() -> dict[str, str]:
    """Return everything that the bits of a simulation or policy may depend on, by name.

    On platforms that agree in all entries but :data:`POLICIES_ONLY`, equal actions give equal bits.
    On others they often do, but only a tolerance can be demanded. On platforms that agree in all
    entries, policies act alike too.
    """
    return dict(_fingerprint())


def _processor() -> str:
    """Return the processor's vendor, family and model."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        return platform.processor()
    found = [
        re.search(rf"^{name}\s*:\s*(.*)$", text, re.MULTILINE)
        for name in ("vendor_id", "cpu family", "model")
    ]
    return " ".join(match[1] for match in found if match) or platform.processor()


def _linear_algebra() -> str:
    """Return NumPy's BLAS, its version and the kernel that it has chosen here."""
    found = [each for each in threadpool_info() if each["user_api"] == "blas"]
    packages = Path(np.__file__).resolve().parents[1]
    own = [each for each in found if Path(each["filepath"]).is_relative_to(packages / "numpy.libs")]
    names = ("internal_api", "version", "architecture")
    libraries = {
        " ".join(str(each.get(name, "")) for name in names).strip() for each in own or found
    }
    return ", ".join(sorted(libraries)) or "unknown"


def _libm() -> str:
    """Return a hash of results of the C library's functions, whose code depends on the processor.

    The results differ in about one of a thousand last bits.
    """
    one = (math.sin, math.cos, math.exp, math.expm1, math.log, math.asin, math.acos, math.atan)
    points = [(i + 0.5) / 4096 for i in range(4096)]
    values = [function(x) for function in one for x in points]
    values += [math.atan2(x, 1.5 - x) for x in points] + [x**1.7 for x in points]
    return hashlib.sha256(struct.pack(f"<{len(values)}d", *values)).hexdigest()[:16]


PLAYS: Final[tuple[Root, ...]] = (Batch, PackagedPolicy, forkserver.main)
"""The code that plays an episode: in this process, and in a sandbox."""

COLIFT: Final = "colift"


def origin() -> dict[str, str]:
    """Return everything besides policy and suite that can change a result, by name.

    It is the platform's :func:`.fingerprint`, and under ``colift`` a hash of the code that plays
    and scores: the fingerprint covers only the code that simulates. Policies have digests.
    """
    return {**fingerprint(), COLIFT: _code()}


def platform_of(origin: Mapping[str, str]) -> dict[str, str]:
    """Return the part of an origin that is the platform's fingerprint."""
    return {name: value for name, value in origin.items() if name != COLIFT}


def check_same_origin(
    found: Mapping[str, str], wanted: Mapping[str, str], where: str, other: str
) -> None:
    """Raise an InputError that names the first difference of two origins, if there is one.

    Parameters
    ----------
    found, wanted
        The origins; only entries of the second are compared.
    where, other
        Their places, in words: ``on worker 3``, ``here``.
    """
    for name, value in wanted.items():
        if found.get(name) != value:
            raise InputError(
                f"results would depend on the machine: {name} is {found.get(name)!r} {where} "
                f"and {value!r} {other}"
            )


@functools.cache
def _code() -> str:
    return code_hash(*PLAYS, without=stated())
