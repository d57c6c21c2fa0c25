"""``colift check``: the checks of a submission, and its score."""

import dataclasses
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Final

import typer
from colift.agents.spec import AUTO, NONE, AgentSpec
from colift.agents.submissions import from_file
from colift.agents.submissions.choice import auto_level, usable_level
from colift.agents.submissions.manifest import Manifest
from colift.agents.submissions.new import AUTHOR, DESCRIPTION, check_author, template
from colift.agents.submissions.packages import undeclared
from colift.agents.submissions.submission import Submission, open_submission
from colift.base.errors import InputError
from colift.benchmark.execution.progress import workers
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.tables.failures import printed_lines
from colift.benchmark.tables.printing import counted, stdout_console
from colift.benchmark.verification.audit import AUDIT
from colift.benchmark.verification.checking import INTERFACE, SUITE, Check, presubmission_checks
from colift.cli.completion import suites
from colift.cli.document import print_json
from colift.cli.options import AsJson, Jobs
from colift.cli.remedies import argument, explained
from rich.console import Console
from rich.text import Text

COLUMN: Final = 21
"""Column in which the message of a check begins."""


def check(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="The submission's folder.")],
    isolation: Annotated[
        str,
        typer.Option(
            metavar="LEVEL",
            help="Isolation of the policy: auto (the strongest level that works here), bubblewrap, "
            "landlock, limits, or none (in this process: for code that you trust).",
        ),
    ] = AUTO,
    suite: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Suite whose task the policy plays; only a part of a large suite is played.",
            autocompletion=suites,
        ),
    ] = SUITE,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Check a submission: files, interface, determinism, its score, and the time of a step.

    It plays 24 lifts of about 70 steps: seconds for a policy that answers within milliseconds,
    minutes for one that takes a tenth of a second per step. The score is the RMSE on quick-v1, the
    same number that a board of that suite shows; or, with --suite, on lifts of another suite. Exit
    code 1 if a check fails.

    Example: colift check mine
    """
    level = usable_level(isolation)
    console, done = stdout_console(), []
    for each in all_checks(folder, level, isolation == NONE, jobs, make_suite(suite)):
        done.append(each)
        if not as_json:
            _show(console, each)
    failed = sum(not each.ok for each in done)
    name, option = argument(folder), "" if suite == SUITE else f" --suite {suite}"
    if as_json:
        print_json(_content(folder, done))
    elif failed:
        fix = f"Fix the submission, then: colift check {name}{option}"
        _print(console, f"{counted(failed, 'check')} failed. {fix}")
    else:
        submit = f"colift submit {name} --board PATH{option}"
        _print(console, f"Next: colift run {name}{option}, or {submit}")
    if failed:
        raise typer.Exit(1)


def all_checks(
    folder: Path, level: str | None, trusted: bool, jobs: int | None, suite: Suite | None = None
) -> Iterator[Check]:
    """Yield the checks of the folder, then those of the policy in it."""
    try:
        submission = open_submission(folder)
    except InputError as error:
        yield Check(name="files", ok=False, message=explained(error))
        return
    yield from submission_checks(submission, level, trusted, jobs, suite)


def submission_checks(
    submission: Submission,
    level: str | None,
    trusted: bool,
    jobs: int | None,
    suite: Suite | None = None,
) -> Iterator[Check]:
    """Yield the checks of a submission that has been read, then those of its policy."""
    yield from _files(submission)
    policy: AgentSpec
    fresh: AgentSpec
    if trusted:
        policy = fresh = submission.trusted()
    else:
        policy = submission.sandboxed(level or auto_level())
        fresh = dataclasses.replace(policy, instance=AUDIT)

    def evaluate(spec: AgentSpec, suite: Suite) -> Run:
        with workers(suite.name, suite.size, jobs) as (pool, progress):
            return run_suite(spec, suite, executor=pool, progress=progress)

    for each in presubmission_checks(policy, fresh, evaluate, suite):
        yield each
        if each.name == INTERFACE and each.ok and submission.manifest.model:
            yield _network(submission)


def _network(submission: Submission) -> Check:
    """Return what was bound to what in a network that has been made in its sandbox."""
    # Only this kind of submission needs the extra.
    from colift.agents.submissions.bound import bound_text

    return Check(name="network", ok=True, message=bound_text(submission))


def _files(submission: Submission) -> Iterator[Check]:
    contents, manifest = submission.contents, submission.manifest
    size = f"{contents.size / 1000:.1f} kB"
    text = f"{len(contents.files)} files, {size}, digest {submission.digest}"
    yield Check(name="files", ok=True, message=text)
    text = f"{manifest.name} by {', '.join(manifest.authors)}; licence {manifest.licence}"
    wanted = [
        missing
        for missing, wanting in (
            ("the authors", _unsigned(manifest)),
            ("a description (it is that of 'colift new')", _undescribed(submission)),
        )
        if wanting
    ]
    if _unsigned(manifest):
        text += f"; boards refuse the author {AUTHOR!r}"
    if wanted:
        text += f". Add to policy.toml {' and '.join(wanted)}"
    yield Check(name="manifest", ok=True, message=text, warning=bool(wanted))
    wrong = list(undeclared(submission.folder, contents, manifest.packages))
    none = "none: a network runs without code" if manifest.model else "none but Python's own"
    text = "; ".join(wrong) or ", ".join(manifest.packages) or none
    yield Check(name="packages", ok=not wrong, message=text)


def _unsigned(manifest: Manifest) -> bool:
    """Return whether a manifest still has the author that 'colift new' wrote."""
    try:
        check_author(manifest)
    except InputError:
        return True
    return False


def _undescribed(submission: Submission) -> bool:
    """Return whether an edited policy still has the description that 'colift new' wrote."""
    module, _, _ = submission.manifest.entry_point.partition(":")
    source = submission.folder / f"{module}.py"
    edited = not source.is_file() or source.read_text(errors="replace") != template("policy.py")
    return edited and submission.manifest.description in (DESCRIPTION, from_file.DESCRIPTION)


def _show(console: Console, check: Check) -> None:
    """Print a check at once, even into a pipe."""
    mark = Text("failed", "bold red")
    if check.ok:
        mark = Text("warn  ", "bold yellow") if check.warning else Text("ok    ", "green")
    width = max(console.width - COLUMN, 20)
    lines = textwrap.wrap(check.message, width, break_long_words=False, break_on_hyphens=False)
    margin = "\n" + " " * COLUMN
    text = Text.assemble(mark, f"  {check.name:<11}  ", margin.join(lines))
    if lines := printed_lines(check.printed):
        text.append(margin + "\n".join(lines), "dim")
    console.print(text, soft_wrap=True, highlight=False)
    console.file.flush()


def _print(console: Console, text: str) -> None:
    console.print(Text(text), soft_wrap=True)


def _content(folder: Path, checks: list[Check]) -> dict[str, Any]:
    results = [each.results for each in checks if each.results is not None]
    return {
        "submission": str(folder),
        "ok": all(each.ok for each in checks),
        "checks": [
            {
                "name": each.name,
                "ok": each.ok,
                "warning": each.warning,
                "message": each.message,
                "printed": each.printed,
            }
            for each in checks
        ],
        "results": results[0].plain() if results else None,
    }
