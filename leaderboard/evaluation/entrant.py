"""Entrants of an evaluation: submissions and built-in policies, and their isolation."""

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import Final

from colift.agents import control
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.host.levels import Choice, choose, fault
from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.agents.sandbox.host.process import BUBBLEWRAP
from colift.agents.spec import AUTO, AgentSpec
from colift.agents.submissions.manifest import Manifest
from colift.agents.submissions.submission import Submission
from colift.base.errors import EvaluatorFault, InputError
from colift.base.registry import POLICIES, lookup, own_entries, summary
from colift.benchmark.verification.audit import AUDIT

AUTHORS: Final = ("The colift developers",)

LICENCE: Final = "MIT"

LEARNED: Final[Mapping[str, str]] = {
    "anticipate": "anticipate",
    "blend": "reactive",
    "learned": "learned",
    "linear": "linear",
    "reactive": "reactive",
    "task_model": "task_model",
}
"""Policies with learned parameters, and the files that say how they were learned, below
``agents/control/data``."""


@dataclass(frozen=True, kw_only=True)
class Entrant:
    """A submission or built-in policy to be evaluated."""

    manifest: Manifest
    digest: str
    """Digest of all that was submitted."""
    policy: AgentSpec
    fresh: AgentSpec
    """The same policy for the audit: loaded again, in processes that have seen nothing of a run."""

    @classmethod
    def of(cls, submission: Submission, level: str) -> "Entrant":
        """Return a submission as an entrant at an isolation level."""
        policy = submission.sandboxed(level)
        return cls(
            manifest=submission.manifest,
            digest=submission.contents.digest,
            policy=policy,
            fresh=dataclasses.replace(policy, instance=AUDIT),
        )


def builtin_entrant(name: str, level: str = BUBBLEWRAP) -> Entrant:
    """Return one of the built-in policies as an entrant at an isolation level.

    Its digest covers its name, and the code and data that it uses.

    Raises
    ------
    InputError
        If there is no built-in policy of that name.
    """
    entries = own_entries(POLICIES)
    if name not in entries:
        raise InputError(f"no built-in policy {name!r}; there are {', '.join(entries)}")
    source = PolicySpec(text=name).digest()
    policy = SandboxedPolicy(
        name=name,
        origin=entries[name].value,
        source_digest=source,
        isolation=level,
    )
    manifest = Manifest(
        name=name,
        authors=AUTHORS,
        description=summary(lookup(POLICIES, name)),
        licence=LICENCE,
        trained_on=trained_on(name),
    )
    return Entrant(
        manifest=manifest,
        digest=hashlib.sha256(f"colift's own {name}, source {source}".encode()).hexdigest(),
        policy=policy,
        fresh=dataclasses.replace(policy, instance=AUDIT),
    )


def trained_on(name: str) -> str:
    """Return the training data of a built-in policy, with the command that trained it."""
    if name not in LEARNED:
        return "nothing"
    file = files(control).joinpath("data", f"{LEARNED[name]}.json")
    command = json.loads(file.read_text(encoding="utf-8"))["provenance"]["command"]
    return f"lifts that colift simulates ({command})"


class NoSandboxError(EvaluatorFault):
    """No level that this board may use works here at present."""


def board_level(isolation: str) -> Choice:
    """Return the level at which a worker runs submissions.

    Parameters
    ----------
    isolation
        :data:`AUTO`, or the name of a level: ``limits`` must be named explicitly.

    Raises
    ------
    NoSandboxError
        If there is none; the message has the reason.
    InputError
        If there is no level of that name.
    """
    if isolation == AUTO:
        try:
            return choose(verifiable=True)
        except EvaluatorFault as error:
            raise NoSandboxError(str(error)) from error
    reason = fault(isolation)
    if reason is not None:
        raise NoSandboxError(f"isolation {isolation} does not work here: {reason}")
    return Choice(level=isolation, passed={})
