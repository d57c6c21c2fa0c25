"""A new submission from a network in an ONNX file."""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from colift.agents.loading.parameters import split
from colift.agents.onnx.allowed import LARGEST
from colift.agents.submissions import fields
from colift.agents.submissions.new import write_files
from colift.agents.submissions.submission import read_submission
from colift.base.errors import InputError

MODEL: Final = "policy.onnx"
"""The file of the network in the folder."""

DESCRIPTION: Final = "A network."
"""The description of a network."""


def write_from_network(folder: Path, text: str) -> tuple[str, ...]:
    """Write a new submission with a network, which is made and tried in a sandbox before.

    Parameters
    ----------
    folder
        The folder to write, as for :func:`.write_template`.
    text
        ``file.onnx`` or ``file.onnx,view=training``.

    Raises
    ------
    InputError
        If there is no such file or view, the network cannot run, or as :func:`.write_template`.
    """
    path, settings = _parts(text)
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    content = {"description": DESCRIPTION, "model": MODEL, **settings}
    with TemporaryDirectory(prefix="colift-new-") as place:
        tried = Path(place) / "network"
        write_files(tried, data[:LARGEST], content)
        _try(tried, str(path), len(data))
    return write_files(folder, data, content)


def _try(folder: Path, shown: str, size: int) -> None:
    """Make the network once, in a sandbox: a small file can take much memory, or end a process."""
    submission = read_submission(folder)
    if size > LARGEST:
        raise InputError(f"{shown} has more than {LARGEST // 2**20} MiB")
    with submission.sandboxed().agent() as agent:
        if agent.failure is not None:
            reason = str(agent.failure)
            separator = " " if reason.startswith(f"{MODEL} ") else ": "
            raise InputError(f"{shown}{separator}{reason.removeprefix(f'{MODEL} ')}")


def _parts(text: str) -> tuple[Path, dict[str, str]]:
    """Return the file and the settings of the manifest."""
    file, dot, rest = text.partition(".onnx,")
    if not dot:
        return Path(text), {}
    settings = split(rest)
    for name in settings:
        if name != "view":
            raise InputError(f"a network has no parameter {name!r}; it may have a view")
    try:
        return Path(f"{file}.onnx"), {"view": fields.view(settings["view"])}
    except InputError as error:
        raise InputError(f"view {error}") from error
