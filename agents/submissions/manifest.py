"""``policy.toml``, the manifest of a submission."""

from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass
from dataclasses import fields as fields_of
from typing import Any, Final

from colift.agents.submissions import fields
from colift.base.errors import InputError
from colift.base.near_names import did_you_mean
from colift.base.text import parse_toml

MANIFEST: Final = "policy.toml"
"""The manifest's name in the folder."""

LONGEST: Final = 16 * 1024
"""Largest manifest [bytes]: the time to read TOML can grow with the square of its length."""


@dataclass(frozen=True, kw_only=True)
class Manifest:
    """The content of ``policy.toml``; fields without a default are required."""

    name: str
    """Display name: up to 40 letters, digits, spaces and ``. _ + -``; not a built-in policy's."""
    authors: tuple[str, ...]
    """Names of the authors."""
    description: str
    """Description of the method, in a few lines."""
    licence: str
    """Licence, preferably by its SPDX identifier, such as ``MIT``."""
    trained_on: str
    """Training data, and where to find it; ``nothing`` if there is none."""
    link: str = ""
    """Address of a page, paper or repository with more information."""
    model: str = ""
    """The network that is the policy, a file ``.onnx`` in the folder: no code of the folder runs,
    and ``entry_point``, ``parameters``, ``packages`` and ``preload`` are not given."""
    view: str = ""
    """What the network sees and what its actions mean, if not the task's own numbers and metres:
    ``training`` if it was trained in ``training_env()``, ``training-without-pace`` if in
    ``training_env(pace=False)``. Only with ``model``."""
    entry_point: str = "policy:Policy"
    """``module:Class``, with the module in the folder."""
    parameters: str = ""
    """Parameters of the class: ``name=value,name=value``, as after a policy's name."""
    packages: tuple[str, ...] = ()
    """Packages that it imports: any of ``filterpy``, ``numpy``, ``scikit-learn``, ``scipy``."""
    preload: bool = False
    """Without effect: every policy is loaded once. Older manifests have this key."""


READ: Final[Mapping[str, Callable[[Any], Any]]] = {
    "name": fields.name,
    "authors": fields.authors,
    "description": fields.text,
    "licence": fields.text_line,
    "trained_on": fields.text,
    "link": fields.link,
    "model": fields.model,
    "view": fields.view,
    "entry_point": fields.entry_point,
    "parameters": fields.parameters,
    "packages": fields.packages,
    "preload": fields.flag,
}
"""Validator of each key's value."""

OF_CODE: Final = ("entry_point", "parameters", "packages", "preload")
"""Keys of a policy that is code, and not a network."""

REQUIRED: Final = tuple(field.name for field in fields_of(Manifest) if field.default is MISSING)


def read_manifest(data: bytes, where: str = MANIFEST) -> Manifest:
    """Return the content of a manifest.

    Parameters
    ----------
    data
        The bytes of the file.
    where
        The file's name, for messages.

    Raises
    ------
    InputError
        If it is too long or not TOML, a key is missing or unknown, or a value is invalid; the
        message names the file, the key, the value and the valid values.
    """
    if len(data) > LONGEST:
        raise InputError(f"{where} has {len(data)} bytes; at most {LONGEST} are allowed")
    content = parse_toml(data, where)
    for key in content:
        if key not in READ:
            near = did_you_mean(key, READ)
            raise InputError(
                f"{where}: unknown key {fields.shown(key)}; {near}known: {', '.join(READ)}"
            )
    missing = [key for key in REQUIRED if key not in content]
    if missing:
        raise InputError(f"{where}: {missing[0]} is missing; it must have {', '.join(REQUIRED)}")
    for key in OF_CODE:
        if key in content and "model" in content:
            raise InputError(
                f"{where}: model and {key} exclude each other: a network runs without code of yours"
            )
    if "view" in content and "model" not in content:
        raise InputError(
            f"{where}: view is for a network, which model names; code can import the view from "
            "colift.agents.submissions.training_view"
        )
    values = {}
    for key, value in content.items():
        try:
            values[key] = READ[key](value)
        except InputError as error:
            raise InputError(f"{where}: {key} {error}") from error
    return Manifest(**values)
