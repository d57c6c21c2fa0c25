"""``colift new``: a first submission, from a template or a policy."""

from pathlib import Path
from typing import Annotated

import typer
from colift.agents.submissions.from_file import write_from
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import read_submission
from colift.cli.remedies import argument


def new(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="A new folder, or an empty one.")],
    source: Annotated[
        str | None,
        typer.Option(
            "--from",
            metavar="FILE.py:Class|FILE.onnx",
            help="Policy to submit instead of the template; parameters follow a comma. Or a "
            "network, which runs without code; ',view=training' follows if it was trained in "
            "training_env.",
        ),
    ] = None,
) -> None:
    """Write a working submission: a proportional controller to start from.

    policy.py holds the policy, one class; policy.toml names its authors and requirements. With
    --from, the policy is an existing one, named as for 'colift run FILE.py:Class,name=value'.

    Example: colift new mine
    """
    files = write_template(folder) if source is None else write_from(folder, source)
    for name in files:
        print(f"wrote {folder / name}")
    submission = read_submission(folder)
    if submission.manifest.model:
        # Only this kind of submission needs the extra.
        from colift.agents.submissions.bound import bound_text

        print(f"network: {bound_text(submission)}")
    step = "edit them" if source is None else "name the authors in policy.toml"
    print(f"Next: {step}, then colift check {argument(folder)}")
