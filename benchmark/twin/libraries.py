"""JAX, an optional dependency: its device, its threads, and what it has compiled."""

import hashlib
import importlib
import os
from pathlib import Path
from typing import Any, Final

from colift.base.errors import InputError
from colift.base.extras import how_to_install

DEVICES: Final = {"cpu": "cpu", "gpu": "cuda"}
"""JAX's platform for each device."""

_ONE_THREAD = "--xla_cpu_multi_thread_eigen=false"


def require_jax(device: str | None = None) -> None:
    """Import JAX and Optax, so that the modules that use them can be imported.

    On a processor, each computation keeps to one thread, since the bits of a sum that is split
    among threads depend on the number of processors. Products of matrices have the full precision.
    What takes long to compile is kept in the user's folder of caches.

    Parameters
    ----------
    device
        ``"cpu"`` or ``"gpu"``; None is JAX's own choice: a GPU, if there is one and the extra
        ``cuda`` is installed.

    Raises
    ------
    InputError
        If a library is not installed, there is no such device, or JAX is in use on another one.
    """
    if device is not None and device not in DEVICES:
        raise InputError(f"--device must be cpu or gpu, got {device!r}")
    flags = os.environ.get("XLA_FLAGS", "")
    if _ONE_THREAD not in flags:
        os.environ["XLA_FLAGS"] = f"{flags} {_ONE_THREAD}".strip()
    for library in ("jax", "optax"):
        try:
            importlib.import_module(library)
        except ImportError as error:
            raise InputError(f"the twin needs {library}: {how_to_install('train')}") from error
    jax: Any = importlib.import_module("jax")
    if device is not None:
        jax.config.update("jax_platforms", DEVICES[device])
    jax.config.update("jax_default_matmul_precision", "highest")
    if jax.config.jax_compilation_cache_dir is None:
        jax.config.update("jax_compilation_cache_dir", str(_cache()))
    try:
        found = jax.default_backend()
    except (RuntimeError, AssertionError) as error:  # The latter, if no GPU is visible.
        raise InputError(
            f"there is no {device or 'device'} for JAX here; for a GPU of NVIDIA: "
            f"{how_to_install('cuda')}"
        ) from error
    if device is not None and found != device:
        raise InputError(f"JAX is in use on a {found}: choose the device before")


def device_in_use() -> str:
    """Return the device that JAX computes on, ``"cpu"`` or ``"gpu"``."""
    jax: Any = importlib.import_module("jax")
    return str(jax.default_backend())


def _cache() -> Path:
    """Return the folder of compiled code, one for each kind of processor."""
    root = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    info = Path("/proc/cpuinfo")
    kind = [
        line
        for line in (info.read_text() if info.exists() else "").splitlines()
        if line.startswith(("model name", "flags"))
    ]
    digest = hashlib.sha256("\n".join(kind[:2]).encode()).hexdigest()
    return root / "colift" / "compiled" / digest[:16]
