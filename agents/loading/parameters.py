"""Parameters of a policy from text: ``forgetting=0.9,motion.process_noise=1e5``.

Parameters are the keyword arguments of the policy's constructor: numbers, words, and dataclasses of
these. Fields of its argument ``parameters`` go by their own names, fields of any other dataclass by
``outer.inner``. A default of None stands for the dataclass with its own defaults.
"""

import dataclasses
import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, get_type_hints

from colift.agents.loading.values import kind, read_value, readable, without_none, write_value
from colift.base.errors import InputError
from colift.base.near_names import did_you_mean

Path = tuple[str, ...]
"""Names of an argument, of its field, of the field's field, and so on."""


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """One parameter: a single value."""

    owner: type
    """The dataclass of which it is a field, or the policy itself."""
    name: str
    """Its name there."""
    hint: Any
    """Its type."""
    default: Any
    """Its value if it is not set."""


@dataclass(frozen=True, kw_only=True)
class _Group:
    """Parameters of one object: a dataclass, or the policy itself."""

    make: Callable[..., Any]
    members: "dict[str, Parameter | _Group]"


def parameters_of(policy: type) -> dict[str, Parameter]:
    """Return the parameters of a policy, by the names that a user writes.

    Raises
    ------
    InputError
        If the types or defaults of the constructor's arguments cannot be determined.
    """
    return {_name(path): parameter for path, parameter in _flat(_constructor(policy))}


def split(text: str) -> dict[str, str]:
    """Return the values of ``name=value,name=value`` as they are written, by name.

    Raises
    ------
    InputError
        If the text has another form, or a name is given twice.
    """
    values: dict[str, str] = {}
    for item in text.split(","):
        name, sign, value = (part.strip() for part in item.partition("="))
        if not (name and sign):
            raise InputError(f"parameters must be name=value, separated by commas; got {item!r}")
        if name in values:
            raise InputError(f"{name} is given twice")
        values[name] = value
    return values


def merged(*texts: str) -> str:
    """Return parameters as one text, in the order of the names; later ones replace earlier ones.

    Raises
    ------
    InputError
        As :func:`split`.
    """
    values: dict[str, str] = {}
    for text in texts:
        values |= split(text) if text else {}
    return ",".join(f"{name}={values[name]}" for name in sorted(values))


def read_values(policy: type, text: str) -> dict[str, Any]:
    """Return the values of ``name=value,name=value``, by name.

    Raises
    ------
    InputError
        If a name is unknown or given twice, or a value is not of the parameter's type; or as
        :func:`parameters_of`.
    """
    known = parameters_of(policy)
    values: dict[str, Any] = {}
    for name, value in split(text).items():
        if name not in known:
            defaults = ", ".join(f"{each}={write_value(known[each].default)}" for each in known)
            near = did_you_mean(name, known)
            raise InputError(f"no parameter {name!r}; {near}it has {defaults or 'none'}")
        hint = known[name].hint
        try:
            values[name] = read_value(hint, value)
        except ValueError:
            raise InputError(f"{name} must be {kind(hint)}, got {value!r}") from None
    return values


def make_with(policy: type, values: Mapping[str, Any]) -> Any:
    """Return a new policy with the values of :func:`read_values`, and its defaults for the rest."""
    group = _constructor(policy)
    given = {path: values[_name(path)] for path, _ in _flat(group) if _name(path) in values}
    return _make(group, given)


def _constructor(policy: type) -> _Group:
    """Return the policy with its constructor's arguments as members."""
    hints = _hints(policy.__init__)  # type: ignore[misc]
    defaults = {}
    for name, argument in inspect.signature(policy).parameters.items():
        if argument.kind in (argument.KEYWORD_ONLY, argument.POSITIONAL_OR_KEYWORD):
            hint = without_none(hints.get(name))
            defaults[name] = argument.default
            if dataclasses.is_dataclass(hint) and not dataclasses.is_dataclass(argument.default):
                defaults[name] = _default(hint)
    return _Group(make=policy, members=_members(policy, hints, defaults))


def _members(
    owner: type, hints: Mapping[str, Any], defaults: Mapping[str, Any]
) -> dict[str, Parameter | _Group]:
    """Return the parameters of an owner; without an annotation the default gives the type."""
    members: dict[str, Parameter | _Group] = {}
    for name, default in defaults.items():
        hint = hints.get(name, type(default))
        if dataclasses.is_dataclass(default):
            members[name] = _dataclass(default)
        elif readable(hint):
            members[name] = Parameter(owner=owner, name=name, hint=hint, default=default)
    return members


def _dataclass(default: Any) -> _Group:
    """Return a dataclass of parameters from an instance with their defaults."""
    names = [field.name for field in dataclasses.fields(default) if field.init]
    defaults = {name: getattr(default, name) for name in names}
    make = functools.partial(dataclasses.replace, default)
    owner = type(default)
    return _Group(make=make, members=_members(owner, _hints(owner), defaults))


def _hints(owner: Any) -> dict[str, Any]:
    try:
        return get_type_hints(owner)
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
        raise InputError(f"cannot read the types of {owner.__qualname__}: {reason}") from error


def _default(parameters: Any) -> Any:
    try:
        return parameters()
    except TypeError as error:
        raise InputError(f"{parameters.__name__} needs a default for every field") from error


def _flat(group: _Group, above: Path = ()) -> Iterator[tuple[Path, Parameter]]:
    for name, member in group.members.items():
        path = (*above, name)
        if isinstance(member, _Group):
            yield from _flat(member, path)
        else:
            yield path, member


def _name(path: Path) -> str:
    return ".".join(path[1:] if path[0] == "parameters" else path)


def _make(group: _Group, given: Mapping[Path, Any]) -> Any:
    arguments = {}
    for name, member in group.members.items():
        inner = {path[1:]: value for path, value in given.items() if path[0] == name}
        if inner:
            arguments[name] = _make(member, inner) if isinstance(member, _Group) else inner[()]
    return group.make(**arguments)
