"""``colift export``: lifts as data sets for offline learning."""

import re
import shlex
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.agents.humans.recording_notes import notes_of
from colift.base.errors import InputError
from colift.benchmark.bundle import Bundle, one_line
from colift.benchmark.bundle.present import read_claims
from colift.benchmark.execution.pool import checked_jobs
from colift.benchmark.execution.progress import workers
from colift.benchmark.export.contents import Contents
from colift.benchmark.export.exporting import FORMATS, CardWords, check_format, export
from colift.benchmark.export.fixed_sets import SetLift, play_set, set_digest, set_plan
from colift.benchmark.export.folder import check_new
from colift.benchmark.export.observing import spaces
from colift.benchmark.export.provenance import VIEWS, Provenance, of_scenario
from colift.benchmark.export.proving import proved_lifts
from colift.benchmark.export.rules import CONVERTED, NAMES, RULES, digest, rule
from colift.benchmark.real_lifts.session_folder import is_session
from colift.benchmark.suites.suite import Suite, recorded_suite
from colift.benchmark.tables.printing import counted, show
from colift.cli.bundles import mention_others
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import Jobs
from colift.cli.tables.recordings import recordings_text

SIZE: Final = 300
"""Lifts of a fixed set."""

LICENCE: Final = "MIT"
"""Licence of simulated lifts: colift's own."""

OWN_LICENCE: Final = "other"
"""Licence of the lifts of recorded people: that of the recordings."""


def export_lifts(
    bundle: Annotated[
        Path | None,
        typer.Argument(
            metavar="BUNDLE", help="Result bundle of 'colift run --out'; leave it out with --set."
        ),
    ] = None,
    to: Annotated[
        str, typer.Option("--to", metavar="FORMAT", help=f"Format: {' or '.join(FORMATS)}.")
    ] = "minari",
    out: Annotated[
        Path | None, typer.Option("--out", metavar="DIR", help="New folder for the data set.")
    ] = None,
    view: Annotated[
        str,
        typer.Option(
            "--view", metavar="VIEW", help=f"Agents whose data are kept: {' or '.join(VIEWS)}."
        ),
    ] = VIEWS[0],
    fixed: Annotated[
        str | None,
        typer.Option("--set", metavar="NAME", help=f"A fixed set: {', '.join(RULES)}."),
    ] = None,
    lifts: Annotated[
        int | None,
        typer.Option(
            "--lifts",
            metavar="N",
            help="Lifts of a fixed set; default: 300, others to compare: 30, 3000.",
        ),
    ] = None,
    recordings: Annotated[
        Path | None,
        typer.Option(
            "--recordings", metavar="CSV", help="Recorded human motion, for the set 'recorded'."
        ),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace an older export in --out.")] = (
        False
    ),
    jobs: Jobs = None,
) -> None:
    """Export the lifts of a run as a data set, or a fixed set for offline learning.

    A result bundle has no observations: each lift is replayed, and exported only if its states are
    equal to the bit.

    Example: colift export bundle --to minari --out minari
    """
    if (bundle is None) == (fixed is None):
        raise InputError("name either a result bundle, or a fixed set by --set")
    if out is None:
        raise InputError("--out DIR is missing: the new folder for the data set")
    if fixed is None and not (recordings is None and lifts is None):
        raise InputError("--lifts and --recordings need --set: a bundle has its own lifts")
    check_format(to, view)
    check_new(out, replace=force)
    jobs = checked_jobs(jobs)
    with reported_interrupt(f"{out} is not written"):
        if bundle is not None:
            _bundle(bundle, to, out, view, force, jobs)
        elif fixed is not None:
            _set(fixed, SIZE if lifts is None else lifts, recordings, to, out, view, force, jobs)


def _bundle(folder: Path, to: str, out: Path, view: str, force: bool, jobs: int) -> None:
    if is_session(folder):
        raise InputError(f"{folder} is a session: name the bundle of one of its lifts")
    bundle = read_claims(folder)
    mention_others(folder)
    if bundle.recipe.channel is not None:
        raise InputError(
            f"{folder} was played over a channel: its actions answer older observations than those "
            "of their steps; export a run without --channel"
        )
    suite = bundle.run().suite
    provenance = _of_bundle(bundle, suite, folder, to, view)
    real = bundle.recipe.recordings is not None or bundle.recipe.inputs is not None
    words = CardWords(
        about=f"Lifts of {provenance.policy} on {provenance.suite}, from a result bundle.",
        people="recorded or live people" if real else "simulated people of the suite",
        shows=(
            "Each lift was replayed from both agents' actions, and every bit of its states was "
            "equal to the bundle's.",
            "A policy that is trained on lifts of a suite has met its people and seeds: its score "
            "on that suite says nothing. The fixed sets have only people drawn for training.",
        ),
        licence=OWN_LICENCE if real else LICENCE,
    )
    number = len(bundle.episodes)
    with workers("replaying", number, min(jobs, number)) as (pool, progress):
        contents = export(
            out,
            proved_lifts(bundle, suite, both=view == "both", executor=pool, progress=progress),
            spaces(suite.scenarios[0]),
            provenance,
            words,
            form=to,
            replace=force,
        )
    _report(contents, out)
    print("Each lift was replayed: equal to the bit.")


def _of_bundle(bundle: Bundle, suite: Suite, folder: Path, to: str, view: str) -> Provenance:
    policy = bundle.results["policy"]
    return Provenance(
        name=_plain(f"{suite.name}-{policy['name']}"),
        source=f"colift export {shlex.quote(folder.name)} --to {to} --view {view}",
        policy=one_line(policy["name"]),
        policy_digest=policy["digest"],
        suite=suite.name,
        suite_digest=suite.digest,
        view=view,
        converted=False,
        **of_scenario(suite.scenarios[0]),
    )


def _set(
    name: str,
    lifts: int,
    recordings: Path | None,
    to: str,
    out: Path,
    view: str,
    force: bool,
    jobs: int,
) -> None:
    chosen = rule(name)
    plan = set_plan(name, lifts, both=view == "both", recordings=recordings)
    words = CardWords(
        about=chosen.about,
        people=_people(plan, recordings),
        shows=(CONVERTED, *chosen.shows) if plan[0].converted else chosen.shows,
        licence=OWN_LICENCE if chosen.recorded else LICENCE,
    )
    with workers("lifting", lifts, min(jobs, lifts)) as (pool, progress):
        if recordings is not None:
            show(recordings_text(recorded_suite(recordings)))
        contents = export(
            out,
            play_set(plan, executor=pool, progress=progress),
            spaces(plan[0].scenario, converted=plan[0].converted),
            _of_set(name, plan, recordings, to, view),
            words,
            form=to,
            replace=force,
        )
    _report(contents, out)


def _of_set(
    name: str, plan: list[SetLift], recordings: Path | None, to: str, view: str
) -> Provenance:
    agents = rule(name).agents
    motion = "" if recordings is None else f" --recordings {shlex.quote(recordings.name)}"
    return Provenance(
        name=f"{name}-{len(plan)}" + ("" if view == VIEWS[0] else f"-{view}"),
        source=f"colift export --set {name} --lifts {len(plan)}{motion} --to {to} --view {view}",
        policy="; ".join(NAMES[kind] for kind in agents),
        policy_digest="; ".join(map(digest, agents)),
        suite=f"set {name}",
        suite_digest=set_digest(plan),
        view=view,
        converted=plan[0].converted,
        **of_scenario(plan[0].scenario),
    )


def _people(plan: list[SetLift], recordings: Path | None) -> str:
    drawn = f"{plan[0].scenario.subject.name} to {plan[-1].scenario.subject.name}"
    if recordings is None:
        return f"simulated, a new one in each lift: {drawn}"
    notes = notes_of(recordings).text()
    told = f" ({notes})" if notes else ""
    return f"the motion recorded in {recordings.name}{told}, with the arms of {drawn}"


def _report(contents: Contents, out: Path) -> None:
    left_out = f", {contents.empty} without a step left out" if contents.empty else ""
    exported = f"{counted(contents.lifts, 'lift')}, {counted(contents.steps, 'step')}"
    print(f"{exported}{left_out}\nwritten: {out}")


def _plain(text: str) -> str:
    """Return a name of a data set: letters, digits, ``-`` and ``_``."""
    return re.sub(r"[^A-Za-z0-9_]+", "-", text).strip("-")[:80] or "lifts"
