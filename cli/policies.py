"""From what a user calls a policy to what runs it, and how far apart from the scores."""

import hashlib
from pathlib import Path
from typing import Final

from ..agents.errors import InputError
from ..agents.isolation.ladder import DESCRIPTIONS, fault
from ..agents.isolation.sandboxed import SandboxedPolicy
from ..agents.policies.loading import PolicySpec
from ..agents.registry import POLICIES, entries, own_entries
from ..agents.submissions.modules import module_digest
from ..agents.submissions.snapshot import snapshot_file
from ..agents.submissions.submission import DIGEST, open_submission
from ..benchmark.agent_spec import AgentSpec

AUTO: Final = "auto"
"""Colift's own policies by name in this process, all others in the strongest sandbox."""

NONE: Final = "none"
"""Everything in this process."""

HELP: Final = "A name of 'colift list', module:Class, file.py:Class or a submission's folder."
"""What a policy may be, for the help of commands."""


def choose_policy(text: str, isolation: str = AUTO) -> AgentSpec:
    """Return the policy that a user means.

    Parameters
    ----------
    text
        A registered name, ``module:Class`` or ``file.py:Class``, each with parameters after a
        comma if any; or the folder of a submission. A name comes before a folder of that name:
        say ``./name`` for the folder.
    isolation
        ``auto``: colift's own policies by name in this process, all others in the strongest
        sandbox that works here. ``none``: in this process, whatever it is. Else a rung of
        isolation, for any policy.

    Raises
    ------
    InputError
        If there is no such policy, submission or isolation, or the rung does not work here.
    """
    rung = usable_rung(isolation)
    spec = PolicySpec(text=text)
    place, _, parameters = spec.parts
    own = place in own_entries(POLICIES)
    if own and rung is None:
        spec.load()
        return spec
    if own:
        return _sandboxed(spec, entries(POLICIES)[place].value, spec.digest(), rung)
    if place in entries(POLICIES) or ":" in place:
        return spec if isolation == NONE else _foreign(spec, rung)
    if parameters and Path(place).is_dir():
        raise InputError(f"submission {place} takes no parameters; set them in its policy.py")
    if not text or place.endswith(".py") or not ("/" in text or Path(text).is_dir()):
        spec.load()  # Tells that the class is missing, or which names there are.
    submission = open_submission(Path(text))
    return submission.trusted() if isolation == NONE else submission.sandboxed(rung)


def usable_rung(isolation: str) -> str | None:
    """Return the rung that an isolation names; None for ``auto`` and ``none``.

    Raises
    ------
    InputError
        If there is no such isolation, or it does not work here.
    """
    if isolation in (AUTO, NONE):
        return None
    if isolation not in DESCRIPTIONS:
        known = ", ".join((AUTO, *DESCRIPTIONS, NONE))
        raise InputError(f"unknown isolation {isolation!r}; known: {known}")
    reason = fault(isolation)
    if reason is not None:
        raise InputError(f"isolation {isolation} does not work here: {reason}")
    return isolation


def _foreign(spec: PolicySpec, rung: str | None) -> SandboxedPolicy:
    """Return a class of somebody else's in a sandbox, where it sees its own file and packages."""
    place, _, parameters = spec.parts
    if place in entries(POLICIES):
        place = entries(POLICIES)[place].value
    source, _, name = place.rpartition(":")
    if source.endswith(".py"):
        path = Path(source)
        folder, contents = snapshot_file(path)
        digest = contents.files[0].sha256[:DIGEST]
        return _sandboxed(spec, f"{path.name}:{name}", _digest(digest, parameters), rung, folder)
    return _sandboxed(spec, place, _digest(module_digest(source), parameters), rung)


def _sandboxed(
    spec: PolicySpec, place: str, digest: str, rung: str | None, folder: Path | None = None
) -> SandboxedPolicy:
    _, _, parameters = spec.parts
    return SandboxedPolicy(
        name=spec.name,
        place=place,
        parameters=parameters,
        folder=folder,
        source_digest=digest,
        rung=rung,
    )


def _digest(source: str, parameters: str) -> str:
    """Return the digest of a source and the parameters as they are written."""
    if not parameters:
        return source
    told = ",".join(sorted(part.strip() for part in parameters.split(",")))
    return hashlib.sha256(f"{source},{told}".encode()).hexdigest()[:DIGEST]
