"""``policy.toml``: what a submission says of itself."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass
from dataclasses import fields as fields_of
from typing import Any, Final

from ..errors import InputError
from ..near_names import did_you_mean
from . import fields

MANIFEST: Final = "policy.toml"
"""The manifest's name in the folder."""

LONGEST: Final = 16 * 1024
"""Bytes of a manifest. The time to read TOML can grow with the square of its length."""


@dataclass(frozen=True, kw_only=True)
class Manifest:
    """The content of ``policy.toml``; what has no default must be there."""

    name: str
    """What tables call the policy."""
    authors: tuple[str, ...]
    """Who wrote it."""
    description: str
    """What it does, in a few lines."""
    licence: str
    """What others may do with it, such as ``MIT``; best an identifier of the SPDX list."""
    trained_on: str
    """What data it was trained on; ``nothing`` is an answer."""
    link: str = ""
    """Where to read more."""
    entry_point: str = "policy:Policy"
    """``module:Class``, the module a file of the folder."""
    parameters: str = ""
    """What is set of the class: ``name=value,name=value``, as after a comma on the command line."""
    packages: tuple[str, ...] = ()
    """What it needs of :data:`.packages.PACKAGES`."""
    preload: bool = False
    """Whether its module is imported once for many episodes, because that is slow."""


READ: Final[Mapping[str, Callable[[Any], Any]]] = {
    "name": fields.name,
    "authors": fields.authors,
    "description": fields.text,
    "licence": fields.line,
    "trained_on": fields.text,
    "link": fields.link,
    "entry_point": fields.entry_point,
    "parameters": fields.parameters,
    "packages": fields.packages,
    "preload": fields.flag,
}
"""What reads the value of each key."""

REQUIRED: Final = tuple(field.name for field in fields_of(Manifest) if field.default is MISSING)


def read_manifest(data: bytes, where: str = MANIFEST) -> Manifest:
    """Return what a manifest says.

    Parameters
    ----------
    data
        The bytes of the file.
    where
        The file's name, for messages.

    Raises
    ------
    InputError
        If it is too long or no TOML, a key is missing or unknown, or a value is not what it must
        be; the message names the file, the key, the value and what would be right.
    """
    if len(data) > LONGEST:
        raise InputError(f"{where} has {len(data)} bytes; it may have {LONGEST}")
    try:
        content = tomllib.loads(data.decode())
    except UnicodeDecodeError as error:
        raise InputError(f"{where}: must be UTF-8; byte {error.start} is not") from error
    except ValueError as error:
        raise InputError(f"{where}: {error}") from error
    except RecursionError as error:
        raise InputError(f"{where}: lists or tables inside each other too deep") from error
    for key in content:
        if key not in READ:
            near = did_you_mean(key, READ)
            raise InputError(
                f"{where}: unknown key {fields.shown(key)}; {near}known: {', '.join(READ)}"
            )
    missing = [key for key in REQUIRED if key not in content]
    if missing:
        raise InputError(f"{where}: {missing[0]} is missing; it must have {', '.join(REQUIRED)}")
    values = {}
    for key, value in content.items():
        try:
            values[key] = READ[key](value)
        except InputError as error:
            raise InputError(f"{where}: {key} {error}") from error
    return Manifest(**values)
