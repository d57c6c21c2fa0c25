"""JAX, an optional dependency: on the CPU, with one thread for each computation."""

import importlib
import os

from colift.base.errors import InputError
from colift.base.extras import how_to_install

_ONE_THREAD = "--xla_cpu_multi_thread_eigen=false"


def require_jax() -> None:
    """Import JAX and Optax, so that the modules that use them can be imported.

    Each computation keeps to one thread, since the bits of a sum that is split among threads depend
    on the number of processors.

    Raises
    ------
    InputError
        If a library is not installed.
    """
    flags = os.environ.get("XLA_FLAGS", "")
    if _ONE_THREAD not in flags:
        os.environ["XLA_FLAGS"] = f"{flags} {_ONE_THREAD}".strip()
    os.environ.setdefault("JAX_PLATFORMS", "cpu")
    for library in ("jax", "optax"):
        try:
            importlib.import_module(library)
        except ImportError as error:
            raise InputError(f"the twin needs {library}: {how_to_install('train')}") from error
