"""The template of a submission, which works unchanged."""

import json
import re
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any, Final

from colift.agents.submissions import fields
from colift.agents.submissions.manifest import MANIFEST, OF_CODE, Manifest
from colift.base.errors import InputError
from colift.base.places import check_empty

PLACEHOLDER: Final = "my-policy"
"""The name of the policy in the template."""

AUTHOR: Final = "Your Name"
"""The author in the template."""

DESCRIPTION: Final = "Removes a fixed share of the observed height difference."
"""The description in the template."""

POLICY: Final = "policy.py"
"""The file of the policy."""

COMMENTS: Final = 34
"""Column of the comments in the manifest."""

NETWORK: Final = "# an ONNX file in this folder"
"""The comment on a network."""

VIEW: Final = "# what it saw and did in training"
"""The comment on a network's view."""

FILES: Final = (MANIFEST, POLICY)
"""The files of the template."""


def check_author(manifest: Manifest, where: str = MANIFEST) -> None:
    """Refuse a manifest that would publish the author of the template.

    Raises
    ------
    InputError
        If it has that author; the message begins with ``where``, the manifest's name.
    """
    placeholder = [each for each in manifest.authors if each.casefold() == AUTHOR.casefold()]
    if placeholder:
        raise InputError(
            f"{where}: authors still has {placeholder[0]!r}, the placeholder of the template: put "
            "your own name there, it is published"
        )


def template(name: str) -> str:
    """Return the text of one of the template's :data:`FILES`."""
    return files(__package__).joinpath("template", name).read_text()


def write_template(folder: Path) -> tuple[str, ...]:
    """Write a new submission, a proportional controller with comments; return its files.

    Parameters
    ----------
    folder
        A new or empty folder. The policy is named after it, as far as that is a valid name.

    Raises
    ------
    InputError
        If it is not a new or empty folder, or cannot be written.
    """
    return write_files(folder, template(POLICY).encode(), {})


def write_files(folder: Path, policy: bytes, content: Mapping[str, Any]) -> tuple[str, ...]:
    """Write a new submission, and return its files.

    Parameters
    ----------
    folder
        As for :func:`write_template`.
    policy
        The source of its policy, or the bytes of its network.
    content
        Values of the manifest that replace those of the template; with ``model``, the name of the
        network's file, those of code are left out.

    Raises
    ------
    InputError
        As :func:`write_template`.
    """
    check_empty(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        name = content.get("model", POLICY)
        (folder / name).write_bytes(policy)
        (folder / MANIFEST).write_text(_manifest({"name": _name(folder), **content}))
    except OSError as error:
        raise InputError(f"cannot write to {folder}: {error.strerror}") from error
    return MANIFEST, name


def _manifest(content: Mapping[str, Any]) -> str:
    """Return the template's manifest with other values, its comments in place."""
    lines = []
    for line in template(MANIFEST).splitlines():
        key, sign, _ = line.partition(" = ")
        if key in OF_CODE and "model" in content:
            if key == OF_CODE[0]:
                lines += [
                    f"{name} = {json.dumps(content[name])}".ljust(COMMENTS) + comment
                    for name, comment in (("model", NETWORK), ("view", VIEW))
                    if name in content
                ]
            continue
        if sign and key in content:
            _, _, comment = line.partition("  #")
            written = json.dumps(content[key], ensure_ascii=False)  # TOML reads it as JSON does.
            line = f"{key} = {written}".ljust(COMMENTS if comment else 0)
            line += f"# {comment.strip()}" if comment else ""
        lines.append(line)
    return "\n".join(lines) + "\n"


def _name(folder: Path) -> str:
    """Return a policy's name from the folder's; the placeholder if nothing valid is left."""
    name = re.sub(r"[^A-Za-z0-9 ._+-]+", "-", folder.resolve().name).strip(" ._+-")[:40].strip()
    try:
        return fields.name(name)
    except InputError:
        return PLACEHOLDER
