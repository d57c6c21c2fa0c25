"""Objects of registered classes: made, checked, and blamed for the errors of their code."""

import dataclasses
import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from traceback import walk_tb
from typing import Any

import numpy as np
from colift.base.errors import InputError
from colift.base.registry import called, lookup


def make_registered(
    group: str, name: str, check: Callable[[object], str | None], **arguments: object
) -> Any:
    """Return an object of the class that is registered under a name.

    Without arguments it is the same at every call, checked once.

    Parameters
    ----------
    group
        A group of entry points.
    name
        The entry point's name.
    check
        Returns the reason why an object is not what is registered in the group, or None.
    arguments
        Arguments of the class; all its other fields must have defaults.

    Raises
    ------
    InputError
        If the name is unknown, the class cannot be loaded or made, or :func:`class_fault` or the
        check finds a fault.
    """
    kind, title = lookup(group, name), called(group, name)
    again = isinstance(kind, type) and not arguments
    return (_made if again else _make)(kind, title, check, **arguments)


def _make(
    kind: type, title: str, check: Callable[[object], str | None], **arguments: object
) -> Any:
    fault = class_fault(kind)
    if fault is not None:
        raise InputError(f"{title} {fault}")
    missing = [
        each.name
        for each in dataclasses.fields(kind)
        if each.init
        and each.name not in arguments
        and each.default is dataclasses.MISSING
        and each.default_factory is dataclasses.MISSING
    ]
    if missing:
        raise InputError(f"{title} must have a default for each field: {', '.join(missing)}")
    with blaming(title, kind):
        made = kind(**arguments)
        fault = check(made)
    if fault is not None:
        raise InputError(f"{title} {fault}")
    return made


_made = functools.cache(_make)


@contextmanager
def blaming(title: str, source: Any) -> Iterator[None]:
    """Turn errors into an InputError that begins with a title and has the place in the source.

    Parameters
    ----------
    title
        The plugin in words.
    source
        The plugin's class or function.

    Raises
    ------
    InputError
        Instead of any exception in the body.
    """
    try:
        yield
    except InputError as error:
        raise InputError(f"{title}: {error}", remedy=error.remedy, target=error.target) from error
    except Exception as error:
        raise InputError(f"{title} raised {error_at(error, source)}") from error


def class_fault(kind: Any) -> str | None:
    """Return the reason why something is not a plugin's class, or None.

    It must be a frozen dataclass; a subclass of one needs no decorator if it only changes methods.
    """
    return _kind_fault(kind) if isinstance(kind, type) else f"must be a class, got {article(kind)}"


@functools.cache
def _kind_fault(kind: type) -> str | None:
    parameters = getattr(kind, "__dataclass_params__", None)
    own = vars(kind)
    fields = [
        each for each in own.get("__annotations__", {}).values() if "ClassVar" not in str(each)
    ]
    # Without a decorator of its own, its fields are none of the dataclass.
    own_state = "__dataclass_params__" not in own and (fields or "__init__" in own)
    if parameters is None or not parameters.frozen or own_state:
        return "must itself be a frozen dataclass: its fields are in the digest of suites"
    return None


def object_fault(made: Any, protocol: type) -> str | None:
    """Return the reason why an object is not a plugin's, or None.

    Its class must be a frozen dataclass, and it must have all members of the protocol.
    """
    if isinstance(made, type):
        return f"must be an object, got the class {made.__name__}"
    fault = class_fault(type(made))
    if fault is not None:
        return fault
    for name, member in vars(protocol).items():
        if name.startswith("_"):
            continue
        if isinstance(member, property):
            if not hasattr(made, name):
                return f"has no attribute {name}"
        elif not callable(getattr(made, name, None)):
            return f"has no method {name}()"
    return None


def place_of(made: Any) -> str:
    """Return the class of an object, or a class, as in an entry point: ``module:Class``."""
    kind = made if isinstance(made, type) else type(made)
    return f"{kind.__module__}:{kind.__qualname__}"


def article(value: Any) -> str:
    """Return the kind of a value with its article: ``an object of Slope``, ``a function``."""
    if value is None:
        return "None"
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if isinstance(value, np.ndarray):
        return "an array"
    name = type(value).__name__
    if type(value).__module__ == "builtins":
        return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"
    return f"an object of {name}"


def plugin_frames(error: BaseException, source: Any) -> list[tuple[str, str]]:
    """Return the calls of a plugin's code that an error passed through, the innermost last.

    Parameters
    ----------
    error
        The error, with its traceback.
    source
        The plugin's class or function: the code of its package counts.

    Returns
    -------
    list
        Name of the function, and the place as ``file:line``.
    """
    package = _package(source.__module__)
    return [
        (frame.f_code.co_name, f"{frame.f_code.co_filename}:{line}")
        for frame, line in walk_tb(error.__traceback__)
        if _package(frame.f_globals.get("__name__")) == package
    ]


def error_at(error: BaseException, source: Any) -> str:
    """Return an error in words, with the place in a plugin's code if it passed through that."""
    text = f"{type(error).__name__}: {error}".rstrip(": ")
    passed = plugin_frames(error, source)
    return f"{text} ({passed[-1][1]})" if passed else text


def is_ours(source: Any) -> bool:
    """Return whether a class or a function is of colift itself."""
    return _package(source.__module__) == _package(__name__)


def _package(module: object) -> str:
    return str(module).partition(".")[0]
