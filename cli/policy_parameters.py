"""The parameters of a policy, as a person reads them in a terminal."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from rich.console import RenderableType
from rich.padding import Padding
from rich.text import Text

from ..agents.loading.description import ParameterText, described
from ..agents.loading.loading import PolicySpec
from ..agents.registry import summary
from ..agents.sandbox.host.policy import SandboxedPolicy
from ..agents.submissions.manifest import MANIFEST, Manifest
from ..agents.submissions.submission import read_submission
from .policies import choose_policy


def policy_parameters(text: str) -> Iterator[RenderableType]:
    """Yield what a policy is and what can be set of it: names, defaults, kinds, meanings.

    Colift's own is loaded here, any other in a sandbox.

    Raises
    ------
    InputError
        If there is no such policy, or it cannot be made.
    """
    policy = choose_policy(text)
    known: Sequence[ParameterText]
    if isinstance(policy, SandboxedPolicy):
        line, known = policy.described()
    else:
        made = PolicySpec(text=text).load()
        line, known = summary(made), described(made)
    folder = Path(PolicySpec(text=text).parts[0])
    if isinstance(policy, SandboxedPolicy) and (folder / MANIFEST).is_file():
        yield from _manifest(read_submission(folder).manifest, policy.digest())
    else:
        yield Text(f"{line}\n")
    for each in known:
        yield Text.assemble((f"  {each.name}={each.default}", "bold"), (f"  {each.kind}", "dim"))
        if each.meaning:
            yield Padding(Text(each.meaning), (0, 0, 0, 6))
    if known:
        last = f"{known[-1].name}={known[-1].default}"
        place = PolicySpec(text=text).parts[0]
        yield Text(f"\nThese are the defaults. To set one: colift run {place},{last}")
    else:
        yield Text("It has no parameters.")


def _manifest(manifest: Manifest, digest: str) -> Iterator[RenderableType]:
    """Yield what a submission says of itself."""
    yield Text(f"{manifest.name} by {', '.join(manifest.authors)}")
    yield Text(manifest.description)
    yield Text(f"Licence {manifest.licence}; trained on: {manifest.trained_on}; digest {digest}\n")
    if manifest.parameters:
        yield Text(f"It sets {manifest.parameters}.")
