"""A submission: a folder with ``policy.toml`` and its code or network, as a policy to be run."""

import hashlib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.agents.loading.parameters import merged
from colift.agents.loading.policy_files import ONNX, policies_in
from colift.agents.onnx.allowed import LARGEST
from colift.agents.onnx.libraries import require_libraries
from colift.agents.sandbox.host.levels import strongest
from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.agents.submissions.folder import FolderContents, copy_folder, read_folder
from colift.agents.submissions.manifest import MANIFEST, Manifest, read_manifest
from colift.agents.submissions.near_manifest import NAME, files_of, no_manifest
from colift.agents.submissions.snapshot import snapshot
from colift.agents.submissions.trusted import TrustedSubmission
from colift.base.errors import InputError, Remedy

DIGEST: Final = 16
"""Hexadecimal digits of the digests in tables."""


NETWORK: Final = "colift.agents.onnx.policy:OnnxPolicy"
"""The policy that runs a submission's network."""

VIEWED: Final = "colift.agents.submissions.viewed:ViewedNetwork"
"""The policy that runs a submission's network through a view."""


def digest_with(source: str, parameters: str) -> str:
    """Return the digest of a source with parameters as written; of the source alone if none."""
    if not parameters:
        return source
    return hashlib.sha256(f"{source},{parameters}".encode()).hexdigest()[:DIGEST]


@dataclass(frozen=True, kw_only=True)
class Submission:
    """A folder with a valid manifest and valid files; its code has not been run."""

    folder: Path
    """The absolute path of the folder with the files."""
    manifest: Manifest
    contents: FolderContents

    @property
    def digest(self) -> str:
        """The digest in tables: the first digits of the hash of all names and bytes."""
        return self.contents.digest[:DIGEST]

    def sandboxed(self, level: str | None = None, parameters: str = "") -> SandboxedPolicy:
        """Return the policy at an isolation level; None is the strongest that works here.

        ``parameters`` are added to those of the manifest, or replace them.
        """
        return SandboxedPolicy(
            name=self._name(parameters),
            origin=self._place,
            parameters=self._parameters(parameters),
            folder=self.folder,
            source_digest=self._digest(parameters),
            isolation=level or strongest(),
        )

    def trusted(self, parameters: str = "") -> TrustedSubmission:
        """Return the policy to run in this process, without isolation: its code must be trusted."""
        return TrustedSubmission(
            name=self._name(parameters),
            entry_point=self._place,
            parameters=self._parameters(parameters),
            folder=self.folder,
            source_digest=self._digest(parameters),
        )

    @property
    def _place(self) -> str:
        if not self.manifest.model:
            return self.manifest.entry_point
        return VIEWED if self.manifest.view else NETWORK

    def _parameters(self, parameters: str) -> str:
        if not self.manifest.model:
            return merged(self.manifest.parameters, parameters)
        if parameters:
            raise InputError(
                f"{self.manifest.name} is a network, which has no parameters; got {parameters!r}"
            )
        view = f",view={self.manifest.view}" if self.manifest.view else ""
        return f"model={self.manifest.model}{view}"

    def _name(self, parameters: str) -> str:
        return f"{self.manifest.name},{parameters}" if parameters else self.manifest.name

    def _digest(self, parameters: str) -> str:
        return digest_with(self.digest, merged(parameters))


def open_submission(folder: Path) -> Submission:
    """Return the submission in a folder, as a private copy, which later changes do not affect.

    Raises
    ------
    InputError
        As :func:`read_submission`, or if the copy cannot be written.
    """
    _check_no_file(folder)
    if folder.is_dir() and not os.path.lexists(folder / MANIFEST):
        raise no_manifest(files_of(folder), str(folder), NAME)  # Before a large folder is read.
    place, contents = snapshot(folder)
    return _submission(place, contents, str(folder))


def read_submission(folder: Path) -> Submission:
    """Return the submission in a folder, without a copy.

    Raises
    ------
    InputError
        If the folder, its manifest or its files are invalid; the message names the file, the key
        and the valid values.
    """
    _check_no_file(folder)
    contents = read_folder(folder)
    return _submission(folder.absolute(), contents, str(folder))


def copy_submission(folder: Path, target: Path) -> Submission:
    """Return the submission in a folder as a copy in an empty one; it is read only once.

    Raises
    ------
    InputError
        As :func:`read_submission`.
    UnwritableError
        If the copy cannot be written.
    """
    _check_no_file(folder)
    return _submission(target.absolute(), copy_folder(folder, target), str(folder))


def _check_no_file(folder: Path) -> None:
    """Refuse a file, or a class in a file, in place of a folder."""
    file, _, _ = str(folder).rpartition(":")
    for path in (folder, Path(file)):
        if path.is_file():
            raise _a_file(path)


def _a_file(path: Path) -> InputError:
    message, target = f"{path} is a file; a submission is a folder", str(path)
    if path.suffix == ".py":
        target += f":{[*policies_in(path), 'Class'][0]}"
    elif path.suffix != ONNX:
        return InputError(message)
    return InputError(message, remedy=Remedy.SUBMISSION_FROM_FILE, target=target)


def _submission(folder: Path, contents: FolderContents, shown: str) -> Submission:
    """Return the submission of files that have been read; ``shown`` is the user's path."""
    if MANIFEST not in contents.paths:
        raise no_manifest(contents.paths, shown, NAME)
    manifest = read_manifest((folder / MANIFEST).read_bytes(), f"{shown}/{MANIFEST}")
    if manifest.model:
        _check_network(manifest.model, contents, shown)
        return Submission(folder=folder, manifest=manifest, contents=contents)
    module, _, _ = manifest.entry_point.partition(":")
    file = module.replace(".", "/")
    if not {f"{file}.py", f"{file}/__init__.py"} & set(contents.paths):
        sources = [path for path in contents.paths if path.endswith(".py")]
        raise InputError(
            f"{shown}/{MANIFEST}: entry_point {manifest.entry_point!r} needs a file {file}.py; "
            f"the folder has {', '.join(sources[:5]) or 'no Python file'}"
        )
    return Submission(folder=folder, manifest=manifest, contents=contents)


def _check_network(model: str, contents: FolderContents, shown: str) -> None:
    """Raise an InputError if a network is missing or too large.

    It is read in the sandbox only: a small file can take much memory.
    """
    require_libraries()
    sizes = {file.path: file.size for file in contents.files}
    if model not in sizes:
        networks = [path for path in contents.paths if path.endswith(".onnx")]
        raise InputError(
            f"{shown}/{MANIFEST}: model {model!r} is not in the folder; it has "
            f"{', '.join(networks[:5]) or 'no .onnx file'}"
        )
    if sizes[model] > LARGEST:
        raise InputError(f"{shown}/{model} has {sizes[model]} bytes; a network may have {LARGEST}")
