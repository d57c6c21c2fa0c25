"""``colift verify``: verification of a bundle's scores from its actions."""

import itertools
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.base.errors import EvaluatorFault, InputError
from colift.benchmark.bundle import (
    check_bundle_folder,
    check_unfinished,
    is_bundle,
    one_line,
    write_bundle,
)
from colift.benchmark.execution.pool import checked_jobs, process_pool
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.execution.runner import Run
from colift.benchmark.real_lifts.session_folder import is_session, lift_folders, sessions_in
from colift.benchmark.results.baselines import HUMAN_HUMAN
from colift.benchmark.results.headline import headline
from colift.benchmark.tables.printing import counted, show
from colift.benchmark.verification import ACTIONS_FROM_LOG, PROVES, UNPROVEN, Verdict, verify
from colift.cli.bundles import mention_others
from colift.cli.document import print_json
from colift.cli.options import AsJson, Jobs
from colift.cli.remedies import argument, naming

MOST_SESSIONS: Final = 5
"""Largest number of sessions that are named."""

MOST_LINES: Final = 20
"""Largest number of differences between platforms that are printed."""


def verify_bundle(
    bundle: Annotated[
        Path,
        typer.Argument(
            metavar="BUNDLE",
            help="A result bundle of 'colift run --out' or of a board, or the session of "
            "live lifts of 'colift play'.",
        ),
    ],
    jobs: Jobs = None,
    rescore: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder for the same bundle with the scores of this version of colift.",
        ),
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="Replace the finished result bundle in --rescore.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Simulate each lift of a result bundle again from its actions, and compare every number.

    Nothing in the bundle is trusted, and no policy is run. Exit code 0: verified; 1: refused, with
    the file, the lift and the first step that differ.

    Example: colift verify bundle
    """
    count = checked_jobs(jobs)
    if rescore is not None:
        with naming("--rescore"):
            check_bundle_folder(rescore)
        if not force:
            with naming("--rescore", hint="--force replaces it"):
                check_unfinished(rescore)
    if is_session(bundle):
        if rescore is not None:
            raise InputError("--rescore takes one bundle, not a session: name one of its lifts")
        _verify_session(bundle, count, as_json=as_json)
        return
    _check_not_of_sessions(bundle)
    with _checking(bundle, count) as check:
        verdict = check(bundle)
    mention_others(bundle)
    written = rescore is not None and (verdict.ok or verdict.rescorable)
    if rescore is not None and written:
        _write(rescore, verdict)
    if as_json:
        print_json(verdict.plain())
    elif verdict.run is not None and not verdict.findings:
        print(_proof(bundle, verdict, verdict.run))
        show(PROVES, UNPROVEN)
        if written:
            print(f"Rescored bundle: {rescore}")
    if verdict.findings:
        print(f"{bundle} is refused:", file=sys.stderr)
        for finding in verdict.findings:
            print(f"  {finding}", file=sys.stderr)
    elif verdict.scoring is not None and not written:
        print(_outdated(bundle, *verdict.scoring), file=sys.stderr)
    if not (verdict.ok or written):
        raise typer.Exit(1)


def _check_not_of_sessions(folder: Path) -> None:
    """Raise an InputError if a folder is that of several sessions, as 'colift play' makes it."""
    sessions = [] if is_bundle(folder) else sessions_in(folder)
    if not sessions:
        return
    names = ", ".join(each.name for each in sessions[:MOST_SESSIONS])
    more = len(sessions) - MOST_SESSIONS
    example = next(filter(lift_folders, sessions), sessions[0])
    raise InputError(
        f"{folder} contains sessions of live lifts ({names}{f' and {more} more' * (more > 0)}), "
        f"not a result bundle; verify one of them: colift verify {argument(example)}"
    )


@contextmanager
def _checking(shown: Path, jobs: int) -> Iterator[Callable[[Path], Verdict]]:
    """Yield a function that verifies a bundle in several processes and shows its progress."""
    try:
        with process_pool(jobs) as pool, progress_bar(f"verify {shown.name}", None) as progress:
            yield lambda folder: verify(folder, executor=pool, progress=progress)
    except EvaluatorFault as fault:
        print(f"not verified: {fault}; this is not a fault of the bundle", file=sys.stderr)
        raise typer.Exit(1) from None


def _verify_session(session: Path, jobs: int, *, as_json: bool) -> None:
    """Verify each lift of a session of live lifts, and print a line for each."""
    with _checking(session, jobs) as check:
        verdicts = {folder: check(folder) for folder in lift_folders(session)}
    for folder in verdicts:
        mention_others(folder)
    refused = [folder for folder, verdict in verdicts.items() if not verdict.ok]
    if as_json:
        print_json({folder.name: verdict.plain() for folder, verdict in verdicts.items()})
    for folder, verdict in {} if as_json else verdicts.items():
        if not verdict.findings and verdict.run is not None:
            rmse = verdict.run.episodes[0].scores["rmse_mm"]
            how = "equal to the bit" if verdict.bit_equal else "within the tolerance"
            print(f"{folder.name}: {rmse:.2f} mm, {_goals(verdict)}{how}")
        for finding in verdict.findings:
            print(f"{folder.name}: {finding}", file=sys.stderr)
        if not verdict.findings and verdict.scoring is not None:
            print(_outdated(folder, *verdict.scoring), file=sys.stderr)
    if verdicts and not as_json:
        print(_count(len(verdicts) - len(refused), len(verdicts)))
    if not verdicts:
        print(f"{session} has no lift to verify: none has counted yet", file=sys.stderr)
    if refused or not verdicts:
        raise typer.Exit(1)


def _goals(verdict: Verdict) -> str:
    """Return the verified goal error of a live lift; empty if its bundle claims none."""
    goals = None if verdict.results is None else verdict.results.goals
    if goals is None or goals.mean.mean is None:
        return ""
    return f"{goals.mean.mean:.1f} mm from its goals, "


def _count(verified: int, lifts: int) -> str:
    """Return the sentence on how many lifts of a session are verified."""
    if lifts == 1:
        return f"The live lift is {'verified' if verified else 'not verified'}."
    return f"{verified} of {lifts} live lifts are verified."


def _write(folder: Path, verdict: Verdict) -> None:
    if verdict.run is not None and verdict.results is not None:
        write_bundle(
            folder,
            verdict.run,
            verdict.results.plain(),
            human_human=verdict.results.baselines.get(HUMAN_HUMAN),
            platform=verdict.platform,
        )


def _proof(bundle: Path, verdict: Verdict, run: Run) -> str:
    """Return the text about a bundle whose numbers were repeated."""
    if verdict.bit_equal:
        how = "equal to the bit"
    else:
        how = f"within {verdict.tolerance_mm} mm, since it comes from another platform"
    lines = [
        f"{counted(len(run.episodes), 'lift')} of {run.policy} on {verdict.suite} "
        f"simulated again: {how}."
    ]
    lines += [
        f"  {name}: {there} there, {here} here"
        for name, (there, here) in itertools.islice(verdict.other_platform.items(), MOST_LINES)
    ]
    if verdict.policies_differ:
        lines.append(ACTIONS_FROM_LOG)
    if verdict.results is not None:
        lines.append(headline(verdict.results.summary))
    if verdict.ok:
        lines.append(f"{bundle} is verified.")
    # Names and versions come from the bundle: control sequences must not reach a terminal.
    return "\n".join(map(one_line, lines))


def _outdated(bundle: Path, there: int, here: int) -> str:
    if there > here:
        return (
            f"{bundle} has scores of version {there}, this colift computes version {here}: not "
            "compared. The actions are verified; compare the scores with a newer colift."
        )
    return (
        f"{bundle} has scores of version {there}, this colift computes version {here}: not "
        f"compared. The actions are verified and the numbers above are the present ones; "
        f"colift verify {bundle} --rescore DIR writes a bundle with them."
    )
