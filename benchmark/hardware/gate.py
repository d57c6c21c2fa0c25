"""A robot that hangs: services none of whose methods answers while a gate is closed."""

import functools
import inspect
import threading
from collections.abc import Callable
from typing import Any


def behind(service: Any, gate: threading.Event) -> Any:
    """Return a service whose public methods wait until a gate is open, and then do the same."""

    def waiting(method: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(method)
        def wait(self: Any, *arguments: Any) -> Any:
            gate.wait()
            return method(*arguments)

        # libqi counts the arguments.
        own = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
        signature = inspect.signature(method)
        wait.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=[own, *signature.parameters.values()]
        )
        return wait

    methods = {
        name: waiting(method)
        for name, method in inspect.getmembers(service, inspect.ismethod)
        if not name.startswith("_")
    }
    # Called in several threads, or one that waits would keep the others from waiting.
    return type(type(service).__name__, (), {"__qi_threading__": "multi", **methods})()
