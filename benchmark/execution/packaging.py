"""Takes a policy to machines that do not share a file system with this one."""

import dataclasses
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import msgpack

from ...agents.agent import Agent
from ...agents.errors import EvaluatorFault, InputError
from ...agents.loading.loading import PolicySpec
from ...agents.sandbox.host.policy import SandboxedPolicy
from ...agents.spec import AgentSpec, Paced
from ...agents.submissions.folder import read_folder
from ...agents.submissions.modules import module_digest
from ...agents.submissions.snapshot import snapshot, snapshot_file
from ...agents.submissions.trusted import TrustedSubmission


@dataclass(frozen=True, kw_only=True)
class ShippedPolicy:
    """A policy with its files inside, as :class:`.AgentSpec`: the same agent on every machine."""

    spec: AgentSpec
    """The policy, where it comes from."""
    name: str
    isolation: str
    source_digest: str
    """The policy's digest, where it comes from."""
    module_digest: str = ""
    """The digest of the installed module that it is in; empty if it comes with its files."""
    files: bytes = b""
    """Its files, as msgpack: where in their folder each is, and its content."""
    contents_digest: str = ""
    """The digest of all files; empty if there is none."""

    def digest(self) -> str:
        """Return the hash of the policy's source."""
        return self.source_digest

    def check(self) -> None:
        """Do nothing: it was checked before it was shipped."""

    def paced(self, period: float) -> "ShippedPolicy":
        """Return the same policy with the budgets of a control period [s]."""
        spec = self.spec.paced(period) if isinstance(self.spec, Paced) else self.spec
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
            # Whoever plays an episode takes other errors for the policy's.
            raise EvaluatorFault(str(error)) from error
        with policy.agent() as agent:
            yield agent


def shipped(spec: AgentSpec) -> ShippedPolicy:
    """Return a policy with its files, to be run by the same isolation everywhere.

    Of ``file.py:Class`` the file alone is taken along, of a submission its folder; what is named
    ``module:Class`` has to be installed over there.

    Raises
    ------
    InputError
        If there is no such policy, or its files are more than a submission may be.
    """
    if isinstance(spec, ShippedPolicy):
        return spec
    spec.check()
    source_digest, folder, module = spec.digest(), _folder(spec), ""
    if isinstance(spec, SandboxedPolicy) and folder is None:
        module = spec.place.rpartition(":")[0]
    files, contents_digest = b"", ""
    if folder is not None:
        contents = read_folder(folder)
        files = msgpack.packb([(path, (folder / path).read_bytes()) for path in contents.paths])
        contents_digest = contents.digest
    return ShippedPolicy(
        spec=spec,
        name=spec.name,
        isolation=spec.isolation,
        source_digest=source_digest,
        module_digest=module_digest(module) if module else "",
        files=files,
        contents_digest=contents_digest,
    )


def _folder(spec: AgentSpec) -> Path | None:
    """Return the folder with a policy's files, if it has files of its own."""
    match spec:
        case SandboxedPolicy(folder=folder) | TrustedSubmission(folder=folder):
            return folder
        case PolicySpec():
            source, _, _ = spec.parts[0].rpartition(":")
            return snapshot_file(Path(source))[0] if source.endswith(".py") else None
    return None


_moved: Final[dict[str, AgentSpec]] = {}
"""The policies that this process has unpacked or looked at, as they are found here."""
_moving: Final = threading.Lock()


def _local(policy: ShippedPolicy) -> AgentSpec:
    """Return the policy as it is found on this machine."""
    key = f"{policy.spec!r} {policy.source_digest} {policy.contents_digest}"
    with _moving:
        if key not in _moved:
            _moved[key] = _unpacked(policy) if policy.contents_digest else _same(policy)
        return _moved[key]


def _unpacked(policy: ShippedPolicy) -> AgentSpec:
    """Return the policy with its files in a private folder of this machine."""
    with tempfile.TemporaryDirectory(prefix="colift-") as temporary:
        for name, content in msgpack.unpackb(policy.files):
            place = Path(temporary, name)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
        folder, contents = snapshot(Path(temporary))
    if contents.digest != policy.contents_digest:
        raise InputError(f"the files of policy {policy.name} have changed on the way")
    match policy.spec:
        case SandboxedPolicy() | TrustedSubmission():
            return dataclasses.replace(policy.spec, folder=folder)
        case PolicySpec():
            place_, comma, parameters = policy.spec.parts
            source, _, name = place_.rpartition(":")
            moved = f"{folder / Path(source).name}:{name}{comma}{parameters}"
            return PolicySpec(text=moved)
    raise TypeError(f"a {type(policy.spec).__name__} has no files")


def _same(policy: ShippedPolicy) -> AgentSpec:
    """Return the policy if this machine has the same one."""
    spec = policy.spec
    if isinstance(spec, SandboxedPolicy):
        wanted, here = policy.module_digest, module_digest(spec.place.rpartition(":")[0])
    else:
        wanted, here = policy.source_digest, spec.digest()
    if here != wanted:
        raise InputError(
            f"policy {policy.name} has digest {here} on a worker and {wanted} here: "
            "install the same one"
        )
    return spec
