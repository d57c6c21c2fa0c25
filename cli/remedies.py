"""Errors in the words of the command line: options, and the commands that remedy them."""

import shlex
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from typing import Final, TypeVar

from colift.base.errors import InputError, Remedy
from colift.base.registry import POLICIES, entries

T = TypeVar("T")

REMEDIES: Final[Mapping[Remedy, str]] = {
    Remedy.RESUME: "--resume continues it",
    Remedy.RESCORE: "'colift verify {target} --rescore DIR' writes a bundle with present scores",
    Remedy.NEW_SUBMISSION: "'colift new DIR' writes one",
    Remedy.SUBMISSION_FROM_FILE: "'colift new DIR --from {target}' makes one from it",
    Remedy.LIST: "'colift list' lists all names",
}
"""The option or command for each remedy."""


def explained(error: InputError) -> str:
    """Return an error with the option or the command that remedies it, if there is one."""
    if error.remedy is None:
        return str(error)
    return f"{error} ({REMEDIES[error.remedy].format(target=error.target)})"


@contextmanager
def naming(option: str, hint: str = "") -> Iterator[None]:
    """Put an option before the message of an InputError, and a hint, if given, after it."""
    try:
        yield
    except InputError as error:
        parts = (f"{option}: {explained(error)}", hint)
        raise InputError("; ".join(filter(None, parts))) from error


@contextmanager
def opened(context: AbstractContextManager[T], option: str) -> Iterator[T]:
    """Enter a context; an InputError from entering it names the option, one from the body not."""
    with ExitStack() as stack:
        with naming(option):
            value = stack.enter_context(context)
        yield value


def argument(path: Path) -> str:
    """Return a file or folder as an argument of a command: quoted, and never a policy's name."""
    shown = str(path)
    if shown in entries(POLICIES) or shown.startswith("-"):
        shown = f"./{shown}"
    return shlex.quote(shown)
