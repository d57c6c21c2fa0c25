"""Validators for the fields of ``policy.toml``, one function per field.

Each raises an InputError with the valid values; :mod:`.manifest` adds the file and the key.
"""

import keyword
import re
import sys
from typing import Any, Final
from urllib.parse import urlsplit

from colift.agents.loading.parameters import merged
from colift.agents.submissions.folder import NAME as PART
from colift.agents.submissions.packages import PACKAGES, installed
from colift.agents.submissions.training_view import VIEWS
from colift.base.errors import InputError
from colift.base.registry import POLICIES, own_entries

NAME: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9 ._+-]{0,39}")
LONGEST_LINE: Final = 200
LONGEST_TEXT: Final = 1000
MOST_AUTHORS: Final = 50


def name(value: Any) -> str:
    """Return the display name of the policy."""
    if not (isinstance(value, str) and NAME.fullmatch(value) and value == value.strip()):
        raise _wrong(value, "1 to 40 letters, digits, spaces and . _ + -, a letter or digit first")
    taken = {*own_entries(POLICIES), "human_human"}
    plain = value.lower().replace(" ", "_").replace("-", "_")
    if plain in taken:
        raise InputError(
            f"must differ from colift's own names, which 'colift list policies' shows; got "
            f"{shown(value)}"
        )
    return value


def authors(value: Any) -> tuple[str, ...]:
    """Return the names of the authors."""
    if not isinstance(value, list) or not 0 < len(value) <= MOST_AUTHORS:
        raise _wrong(value, f'a list of 1 to {MOST_AUTHORS} names, such as ["Ada Lovelace"]')
    return tuple(text_line(each) for each in value)


def text_line(value: Any) -> str:
    """Return a line of text."""
    if not (isinstance(value, str) and 0 < len(value.strip()) <= LONGEST_LINE):
        raise _wrong(value, f"a text of 1 to {LONGEST_LINE} characters")
    if not value.isprintable():
        raise _wrong(value, "a text on one line, without control characters")
    return value.strip()


def text(value: Any) -> str:
    """Return a text of one or more lines."""
    if not (isinstance(value, str) and 0 < len(value.strip()) <= LONGEST_TEXT):
        raise _wrong(value, f"a text of 1 to {LONGEST_TEXT} characters")
    if not value.replace("\n", "").isprintable():
        raise _wrong(value, "a text without control characters")
    return value.strip()


def link(value: Any) -> str:
    """Return a web address, or an empty text."""
    if value == "":
        return ""
    valid = "an address that begins with https:// or http://, or empty"
    if not isinstance(value, str) or len(value) > LONGEST_LINE or " " in value:
        raise _wrong(value, valid)
    try:
        address = urlsplit(value)
    except ValueError:
        raise _wrong(value, valid) from None
    good = address.scheme in ("https", "http") and address.hostname and "@" not in address.netloc
    if not (good and value.isascii() and value.isprintable()):
        raise _wrong(value, valid)
    return value


def entry_point(value: Any) -> str:
    """Return the place of the class: ``module:Class``, with the module in the folder."""
    valid = 'module:Class, with the module in this folder, such as "policy:Policy" for policy.py'
    if not isinstance(value, str):
        raise _wrong(value, valid)
    module, colon, policy = value.partition(":")
    parts = [*module.split("."), policy]
    if not colon or not all(part.isascii() and part.isidentifier() for part in parts):
        raise _wrong(value, valid)
    if any(keyword.iskeyword(part) for part in parts):
        raise _wrong(value, f"{valid}, and no keyword of Python")
    if parts[0] in {*sys.stdlib_module_names, *PACKAGES.values(), "colift"}:
        raise _wrong(value, f"{valid}: {parts[0]} is a module of Python or of a package")
    return value


def model(value: Any) -> str:
    """Return the path of a network in the folder."""
    parts = value.split("/") if isinstance(value, str) else []
    if not (parts and parts[-1].endswith(".onnx") and all(map(PART.fullmatch, parts))):
        raise _wrong(value, 'the path of an ONNX file in this folder, such as "policy.onnx"')
    return "/".join(parts)


def view(value: Any) -> str:
    """Return the name of a view, or an empty text."""
    known = " or ".join(f'"{each}"' for each in VIEWS)
    if not isinstance(value, str) or value not in {"", *VIEWS}:
        raise _wrong(value, f"{known}, or empty")
    return value


def parameters(value: Any) -> str:
    """Return the parameters of the class, sorted by name."""
    valid = 'a text such as "gain=1.2,lead=0.25", or empty'
    if not isinstance(value, str) or len(value) > LONGEST_TEXT:
        raise _wrong(value, valid)
    try:
        return merged(value)
    except InputError:
        raise _wrong(value, valid) from None


def packages(value: Any) -> tuple[str, ...]:
    """Return the packages that the policy needs."""
    known = ", ".join(PACKAGES)
    if not isinstance(value, list):
        raise _wrong(value, f"a list of some of: {known}")
    for each in value:
        if not isinstance(each, str) or each not in PACKAGES:
            raise InputError(f"has {shown(each)}, which boards do not provide; known: {known}")
        if not installed(each):
            raise InputError(f"has {each!r}, which is not installed here: pip install {each}")
    return tuple(dict.fromkeys(value))


def flag(value: Any) -> bool:
    """Return true or false."""
    if not isinstance(value, bool):
        raise _wrong(value, "true or false, without quotes")
    return value


def shown(value: Any) -> str:
    """Return a short text of a TOML value, safe for a terminal."""
    if isinstance(value, str):
        return repr(value) if len(value) <= 60 else f"{value[:60]!r}... ({len(value)} characters)"
    if isinstance(value, bool):
        return str(value).lower()
    kinds = {int: "a number", float: "a number", list: "a list", dict: "a table"}
    return kinds.get(type(value), "a date")


def _wrong(value: Any, valid: str) -> InputError:
    return InputError(f"must be {valid}; got {shown(value)}")
