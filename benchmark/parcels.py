"""Calls on their way to the workers of a cluster, and what these do with them."""

import hashlib
import io
import pickle
import threading
from collections.abc import Callable, Mapping
from typing import Any, Final

from .origin import compare, origin

LARGE: Final = 2**16
"""Bytes of a value beyond which it is sent apart from the calls that it is in: once."""

_turn: Final = threading.Lock()


def parcel(
    fn: Callable[..., Any], args: Any, kwargs: Any, send: Callable[[bytes], Any]
) -> tuple[bytes, dict[str, Any]]:
    """Return a pickled call without its large values, and these by their hashes.

    Parameters
    ----------
    fn, args, kwargs
        The call.
    send
        Sends a large value, and returns what stands for it on the cluster.
    """
    from cloudpickle import Pickler

    large: dict[str, Any] = {}

    class Small(Pickler):  # type: ignore[misc]
        def persistent_id(self, value: Any) -> str | None:
            if type(value) is not bytes or len(value) < LARGE:
                return None
            digest = hashlib.sha256(value).hexdigest()
            large[digest] = send(value)
            return digest

    data = io.BytesIO()
    Small(data).dump((fn, args, kwargs))
    return data.getvalue(), large


def call(data: bytes, large: Mapping[str, bytes], wanted: Mapping[str, str]) -> Any:
    """Return what a call returns that :func:`parcel` has pickled: what a worker runs.

    Calls take turns: the engine and the policies may have state that belongs to their process, and
    a worker of Dask's can have many threads.

    Raises
    ------
    InputError
        If this worker is not of the wanted origin.
    """
    compare(origin(), wanted, "on a worker that has joined", "on the others")

    class Whole(pickle.Unpickler):
        def persistent_load(self, digest: str) -> bytes:
            return large[digest]

    with _turn:
        fn, args, kwargs = Whole(io.BytesIO(data)).load()
        return fn(*args, **kwargs)
