"""Packaging of policies for machines that do not share a file system with this one."""

import dataclasses
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import msgpack
from colift.agents.agent import Agent
from colift.agents.spec import AgentSpec, Paced, Portable
from colift.agents.submissions.folder import read_folder
from colift.agents.submissions.modules import module_digest
from colift.agents.submissions.snapshot import snapshot, snapshot_file
from colift.base.errors import EvaluatorFault, InputError


@dataclass(frozen=True, kw_only=True)
class PackagedPolicy:
    """An :class:`.AgentSpec` with the policy's files inside: the same agent on every machine."""

    spec: AgentSpec
    """The policy on the machine where it was packaged."""
    name: str
    isolation: str
    source_digest: str
    """The policy's digest there."""
    installed_digest: str
    """The digest of its installed code; other machines must have the same."""
    packed_files: bytes = b""
    """Its files as msgpack: pairs of the path in their folder and the content."""
    contents_digest: str = ""
    """The digest of all files; empty if there are none."""

    def digest(self) -> str:
        """Return the hash of the policy's source."""
        return self.source_digest

    def check(self) -> None:
        """Do nothing: the policy was checked before it was packaged."""

    def paced(self, period: float, lifts: int = 1) -> "PackagedPolicy":
        """Return the same, with the time budgets of a control period [s] and of many lifts."""
        spec = self.spec.paced(period, lifts) if isinstance(self.spec, Paced) else self.spec
        return dataclasses.replace(self, spec=spec)

    @contextmanager
    def agent(self) -> Iterator[Agent]:
        """Yield a new agent for one episode.

        Raises
        ------
        EvaluatorFault
            If this machine has another policy of that name, or no room for the files.
        """
        try:
            policy = _local(self)
        except (InputError, OSError) as error:
            # Any other error would count as the policy's own failure.
            raise EvaluatorFault(str(error)) from error
        with policy.agent() as agent:
            yield agent


def packaged(spec: AgentSpec) -> PackagedPolicy:
    """Return a policy with its files, to be run at the same isolation level everywhere.

    For ``file.py:Class`` only the file is packaged, for a submission its folder; the module of
    ``module:Class`` must be installed on the other machines.

    Raises
    ------
    InputError
        If there is no such policy, or its files are larger than a submission may be.
    """
    if isinstance(spec, PackagedPolicy):
        return spec
    spec.check()
    path, module = (spec.files, spec.module) if isinstance(spec, Portable) else (None, "")
    source_digest, files, contents_digest = spec.digest(), b"", ""
    if path is not None:
        folder = snapshot_file(path)[0] if path.is_file() else path
        contents = read_folder(folder)
        files = msgpack.packb([(name, (folder / name).read_bytes()) for name in contents.paths])
        contents_digest = contents.digest
    return PackagedPolicy(
        spec=spec,
        name=spec.name,
        isolation=spec.isolation,
        source_digest=source_digest,
        installed_digest=module_digest(module) if module else source_digest,
        packed_files=files,
        contents_digest=contents_digest,
    )


_moved: Final[dict[str, AgentSpec]] = {}
"""The policies that this process has unpacked or compared, as they are on this machine."""
_moving: Final = threading.Lock()


def _local(policy: PackagedPolicy) -> AgentSpec:
    """Return the policy as it is on this machine."""
    key = f"{policy.spec!r} {policy.installed_digest} {policy.contents_digest}"
    with _moving:
        if key not in _moved:
            _moved[key] = _found(policy)
        return _moved[key]


def _found(policy: PackagedPolicy) -> AgentSpec:
    spec = policy.spec
    if policy.contents_digest and isinstance(spec, Portable):
        return _with_files(policy, spec)
    return _installed(policy, spec)


def _with_files(policy: PackagedPolicy, spec: Portable) -> AgentSpec:
    """Return the policy with its files in a private folder of this machine."""
    with tempfile.TemporaryDirectory(prefix="colift-") as temporary:
        for name, content in msgpack.unpackb(policy.packed_files):
            place = Path(temporary, name)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
        folder, contents = snapshot(Path(temporary))
    if contents.digest != policy.contents_digest:
        raise InputError(f"the files of policy {policy.name} were changed in transit")
    return spec.moved(folder)


def _installed(policy: PackagedPolicy, spec: AgentSpec) -> AgentSpec:
    """Return the policy if this machine has the same one."""
    module = spec.module if isinstance(spec, Portable) else ""
    here = module_digest(module) if module else spec.digest()
    if here != policy.installed_digest:
        raise InputError(
            f"policy {policy.name} has digest {here} on a worker, must have "
            f"{policy.installed_digest}: install the same one"
        )
    return spec
