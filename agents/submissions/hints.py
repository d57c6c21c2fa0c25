"""Remedies for texts that name no policy, and for imports that fail in one."""

import re
from pathlib import Path
from typing import Final

from colift.agents.loading.policy_files import ONNX, with_class
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.submissions.manifest import MANIFEST
from colift.agents.submissions.packages import PACKAGES, undeclared
from colift.agents.submissions.snapshot import snapshot_file
from colift.agents.submissions.submission import open_submission
from colift.base.errors import InputError, Remedy
from colift.base.registry import POLICIES, entries

MISSING: Final = re.compile(r"No module named '([\w.]+)'")
"""Python's words for an import of something that is not there."""


def refuse_other_file(origin: str) -> None:
    """Refuse a file, or the name of one without its suffix, that is not yet the name of a policy.

    Raises
    ------
    InputError
        If there is such a file; the message has the form that works.
    """
    path = Path(origin)
    source = path.with_name(f"{path.name}.py") if path.name else path
    if path.is_file() and path.suffix == ONNX:
        raise InputError(
            f"{origin} is a network, not yet a submission",
            remedy=Remedy.SUBMISSION_FROM_FILE,
            target=origin,
        )
    if path.is_file() and path.suffix != ".py":
        if (path.parent / MANIFEST).is_file():
            raise InputError(f"{origin} is a file of a submission; give its folder, {path.parent}")
        raise InputError(
            f"{origin} is no policy: give a name, file.py:Class or a submission's folder",
            remedy=Remedy.LIST,
        )
    if not path.is_dir() and source.is_file():
        form = with_class(source)
        raise InputError(f"unknown policy {origin!r}; for the file {source} give {form}")


def import_hint(text: str, message: str) -> str:
    """Return the remedy for an import that fails in a policy; empty if this is not the error.

    Parameters
    ----------
    text
        The policy, as for a command.
    message
        The error.
    """
    found = MISSING.search(message)
    if found is None:
        return ""
    name = found[1].partition(".")[0]
    origin = PolicySpec(text=text).parts[0]
    source, _, _ = origin.rpartition(":")
    beside = [Path(source).parent / each for each in (f"{name}.py", name)]
    files = [each for each in beside if source.endswith(".py") and each.exists()]
    if files:
        return (
            f"a policy of one file does not see {files[0].name} beside it: 'colift new DIR --from "
            f"{origin}' makes a submission, into which {files[0].name} can be copied"
        )
    return (
        f"boards provide {', '.join(PACKAGES)}; a network of another library can be submitted as "
        "ONNX: 'colift new DIR --from NET.onnx'"
    )


def board_remarks(text: str) -> list[str]:
    """Return a sentence for each import of a policy that boards need not provide.

    The sources are parsed, not run. Installed modules and registered policies are not looked at.
    """
    origin = PolicySpec(text=text).parts[0]
    source, _, _ = origin.rpartition(":")
    if origin in entries(POLICIES):
        return []
    if source.endswith(".py"):
        return list(undeclared(*snapshot_file(Path(source)), tuple(PACKAGES)))
    folder = Path(text) if Path(text).is_dir() else Path(origin)
    if not folder.is_dir():
        return []
    submission = open_submission(folder)
    return list(undeclared(submission.folder, submission.contents, submission.manifest.packages))
