"""A template of a submission, that works as it is."""

import re
from importlib.resources import files
from pathlib import Path
from typing import Final

from ..errors import InputError
from . import fields
from .manifest import MANIFEST

PLACEHOLDER: Final = "my-policy"
"""The name of the policy in the template."""

AUTHOR: Final = "Your Name"
"""Its author there."""

FILES: Final = (MANIFEST, "policy.py")
"""The files of the template."""


def write_template(folder: Path) -> None:
    """Write a new submission: a proportional controller, with comments.

    Parameters
    ----------
    folder
        Where to: a new folder, or an empty one. The policy is called as it, if that is a name for
        a policy.

    Raises
    ------
    InputError
        If something is there already, or it cannot be written.
    """
    try:
        if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
            raise InputError(f"{folder} is there already; name a new folder")
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            raise InputError(f"{folder} is not empty; name a new folder")
        for name in FILES:
            text = files(__package__).joinpath("template", name).read_text()
            if name == MANIFEST:
                text = text.replace(PLACEHOLDER, _name(folder))
            (folder / name).write_text(text)
    except OSError as error:
        raise InputError(f"cannot write to {folder}: {error.strerror}") from error


def _name(folder: Path) -> str:
    """Return the folder's name as far as it can be a policy's."""
    name = re.sub(r"[^A-Za-z0-9 ._+-]+", "-", folder.resolve().name).strip(" ._+-")[:40].strip()
    try:
        return fields.name(name)
    except InputError:
        return PLACEHOLDER
