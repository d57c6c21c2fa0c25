"""The platform: whatever the bits of a simulation may depend on besides seed and actions."""

import functools
import hashlib
import platform
import re
from importlib.metadata import distribution, version
from pathlib import Path
from typing import Final

import numpy as np

ROOT: Final = Path(__file__).parents[2]

SIMULATION: Final = (
    "robots/**/*",
    "agents/actions.py",
    "agents/agent.py",
    "agents/calibration.*",
    "agents/humans/*.py",
    "benchmark/lift.py",
    "benchmark/recorder.py",
    "benchmark/scenario.py",
    "benchmark/seeding.py",
    "benchmark/world/*.py",
)
"""The sources that make a simulation what it is; no policy and no score is among them."""


@functools.cache
def _fingerprint() -> tuple[tuple[str, str], ...]:
    simd = np.show_config(mode="dicts")["SIMD Extensions"]
    return (
        ("machine", f"{platform.system()} {platform.machine()}"),
        ("processor", _processor()),
        # NumPy picks its functions by these, and they differ in the last bit.
        ("vector_extensions", " ".join([*simd["baseline"], *simd["found"]])),
        ("libc", " ".join(platform.libc_ver())),
        ("python", f"{platform.python_implementation()} {platform.python_version()}"),
        ("numpy", version("numpy")),
        ("pybullet", version("pybullet")),
        ("binaries", _binaries("numpy", "pybullet")),
        ("simulation", _sources()),
    )


def fingerprint() -> dict[str, str]:
    """Return what the bits of a simulation may depend on, by name.

    On equal fingerprints equal actions give equal bits. On others they often do, but no more than
    a tolerance can be asked for.
    """
    return dict(_fingerprint())


def _processor() -> str:
    """Return the processor's vendor, family and model, by which linear algebra picks its code."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        return platform.processor()
    found = [
        re.search(rf"^{name}\s*:\s*(.*)$", text, re.MULTILINE)
        for name in ("vendor_id", "cpu family", "model")
    ]
    return " ".join(match[1] for match in found if match) or platform.processor()


def _binaries(*names: str) -> str:
    """Return a hash of the compiled parts of packages, from their installers' records."""
    records = [
        f"{path}={path.hash.value}"
        for name in names
        for path in distribution(name).files or ()
        if path.hash and ".so" in path.suffixes
    ]
    return hashlib.sha256("\n".join(sorted(records)).encode()).hexdigest()[:16]


def _sources() -> str:
    sha = hashlib.sha256()
    found = {path for pattern in SIMULATION for path in ROOT.glob(pattern)}
    for path in sorted(found):
        if path.is_file() and "__pycache__" not in path.parts:
            sha.update(f"{path.relative_to(ROOT)}\n".encode())
            sha.update(hashlib.sha256(path.read_bytes()).digest())
    return sha.hexdigest()[:16]
