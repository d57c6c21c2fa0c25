"""Choice of a policy and its isolation from a command's arguments."""

import functools
import sys
from pathlib import Path

from colift.agents.loading.parameters import merged, split
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.host.levels import LEVELS, choose, fault
from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.agents.spec import AUTO, NONE, AgentSpec
from colift.agents.submissions.hints import import_hint, refuse_other_file
from colift.agents.submissions.modules import module_digest
from colift.agents.submissions.snapshot import snapshot_file
from colift.agents.submissions.submission import digest_with, open_submission
from colift.base.errors import InputError
from colift.base.identity import source_hash
from colift.base.near_names import did_you_mean
from colift.base.registry import POLICIES, entries, entry_of, own_entries


def choose_policy(text: str, isolation: str = AUTO) -> AgentSpec:
    """Return the policy of a command's argument.

    Parameters
    ----------
    text
        A registered name, ``module:Class``, ``file.py:Class`` or the folder of a submission, each
        with or without parameters after a comma. A name precedes a folder of that name: write
        ``./name`` for the folder.
    isolation
        ``auto``: colift's own policies by name in this process, all others in the strongest
        sandbox that works here. ``none``: any policy in this process. Otherwise the isolation level
        of any policy.

    Raises
    ------
    InputError
        If there is no such policy, submission or isolation, or the level does not work here.
    """
    level = usable_level(isolation)
    spec = PolicySpec(text=text)
    origin, comma, parameters = spec.parts
    if comma and not Path(text).is_dir():  # The name of a folder may have a comma.
        split(parameters)
    own = origin in own_entries(POLICIES)
    if own and level is None:
        spec.load()
        return spec
    if own:
        return _sandboxed(spec, entry_of(POLICIES, origin).value, spec.digest(), level)
    if origin in entries(POLICIES) or ":" in origin:
        return spec if isolation == NONE else _foreign(spec, level)
    if Path(text).is_dir():
        origin, parameters = text, ""
    refuse_other_file(origin)
    if not origin or origin.endswith(".py") or not ("/" in origin or Path(origin).is_dir()):
        spec.load()  # Raises: the class is missing, or there is no such name.
    submission = open_submission(Path(origin))
    if isolation == NONE:
        return submission.trusted(parameters)
    return submission.sandboxed(level or auto_level(), parameters)


def checked_policy(text: str, isolation: str = AUTO) -> AgentSpec:
    """Return the policy of a command's argument, after it has been made once.

    Arguments are as for :func:`choose_policy`.

    Raises
    ------
    InputError
        As :func:`choose_policy`, or if it cannot be made; an import that fails, with its remedy.
    """
    policy = choose_policy(text, isolation)
    try:
        policy.check()
    except InputError as error:
        hint = import_hint(text, str(error))
        if not hint:
            raise
        raise InputError(f"{error}; {hint}") from error
    return policy


def usable_level(isolation: str) -> str | None:
    """Return the level of that name; None for ``auto`` and ``none``.

    Raises
    ------
    InputError
        If there is no such isolation, or it does not work here.
    """
    if isolation in (AUTO, NONE):
        return None
    if isolation not in LEVELS:
        known = (AUTO, *LEVELS, NONE)
        near = did_you_mean(isolation, known)
        raise InputError(f"unknown isolation {isolation!r}; {near}known: {', '.join(known)}")
    reason = fault(isolation)
    if reason is not None:
        raise InputError(f"isolation {isolation} does not work here: {reason}")
    return isolation


@functools.cache
def auto_level() -> str:
    """Return the strongest level that works here; report once on stderr which stronger ones do not.

    Raises
    ------
    EvaluatorFault
        If none works.
    """
    choice = choose()
    if choice.passed:
        print(choice, file=sys.stderr)
    return choice.level


def _foreign(spec: PolicySpec, level: str | None) -> SandboxedPolicy:
    """Return a third party's class in a sandbox, where it sees its own file and packages."""
    origin, _, parameters = spec.parts
    if origin in entries(POLICIES):
        origin = entry_of(POLICIES, origin).value
    source, _, name = origin.rpartition(":")
    if source.endswith(".py"):
        path = Path(source)
        folder, _ = snapshot_file(path)
        digest = source_hash((folder / path.name).read_bytes())
        digest = digest_with(digest, merged(parameters))
        return _sandboxed(spec, f"{path.name}:{name}", digest, level, folder)
    return _sandboxed(spec, origin, digest_with(module_digest(source), merged(parameters)), level)


def _sandboxed(
    spec: PolicySpec, origin: str, digest: str, level: str | None, folder: Path | None = None
) -> SandboxedPolicy:
    _, _, parameters = spec.parts
    return SandboxedPolicy(
        name=spec.name,
        origin=origin,
        parameters=parameters,
        folder=folder,
        source_digest=digest,
        isolation=level or auto_level(),
    )
