"""Types of records that were read from outside, compared with their declarations."""

import dataclasses
import math
import types
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints


def mistyped(value: object, kind: Any, where: str) -> str | None:
    """Return what is wrong with a value of a declared type, in words; None if nothing is.

    Parameters
    ----------
    value
        A value; records, mappings and tuples are compared in all their parts.
    kind
        Its type: a record, a mapping or tuple, a union, a literal, or a class. A float may be an
        integer, and is finite.
    where
        The value's name in the words.
    """
    return next(_faults(value, kind, where), None)


def _faults(value: object, kind: Any, where: str) -> Iterator[str]:
    origin, inner = get_origin(kind), get_args(kind)
    if kind is Any:
        return
    if dataclasses.is_dataclass(kind) and isinstance(value, kind):  # type: ignore[arg-type]
        for name, part in _hints(kind).items():  # type: ignore[arg-type]
            yield from _faults(getattr(value, name), part, f"{where}.{name}")
    elif origin in (Union, types.UnionType):
        faults = [next(_faults(value, each, where), None) for each in inner]
        whole = _fault(value, where)
        if None not in faults:  # A fault in a part says more than one of the whole.
            yield next((each for each in faults if each and each != whole), whole)
    elif origin is Literal:
        if value not in inner:
            yield _fault(value, where)
    elif origin is tuple and isinstance(value, tuple):
        kinds = inner[:1] * len(value) if inner[-1] is Ellipsis else inner
        if len(kinds) != len(value):
            yield _fault(value, where)
        for number, (each, part) in enumerate(zip(value, kinds, strict=False)):
            yield from _faults(each, part, f"{where}[{number}]")
    elif origin is not None and isinstance(value, Mapping):
        for name, each in value.items():
            yield from _faults(name, inner[0], f"a key of {where}")
            yield from _faults(each, inner[1], f"{where}.{name}")
    elif kind is float:
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not (number and math.isfinite(value)):  # type: ignore[arg-type]
            yield _fault(value, where)
    elif origin is not None or kind is None or not isinstance(value, kind):
        if not (kind in (None, types.NoneType) and value is None):
            yield _fault(value, where)
    elif kind is int and isinstance(value, bool):
        yield _fault(value, where)


@cache
def _hints(kind: type) -> dict[str, Any]:
    hints = get_type_hints(kind)
    return {each.name: hints[each.name] for each in dataclasses.fields(kind)}


def _fault(value: object, where: str) -> str:
    text = ascii(value)
    return f"{where} cannot be {text if len(text) <= 60 else f'{text[:60]}...'}"
