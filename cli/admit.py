"""``colift admit``: a test of whether the lifts of a suite need coordination."""

import dataclasses
from pathlib import Path
from typing import Annotated, get_args

import numpy as np
import typer
from colift.base.errors import InputError
from colift.benchmark.admission import inference, remembering
from colift.benchmark.admission.assessment import Admission, admission_of, lifts_to_play
from colift.benchmark.admission.control import CONTROL, CONTROL_PEOPLE, control_suite, first_people
from colift.benchmark.admission.inference import inference_of, needs_inference
from colift.benchmark.admission.remembering import memory_of
from colift.benchmark.admission.tuning import Tuned, tune, tunings
from colift.benchmark.execution.pool import checked_jobs
from colift.benchmark.execution.progress import job_bar, workers
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tables.printing import left, show, table
from colift.benchmark.training import session_kinds
from colift.benchmark.training.apg_settings import ApgSettings, pair_settings
from colift.benchmark.training.session_kinds import Kind, session_budget
from colift.benchmark.training.told_network import write_networks, write_weights
from colift.benchmark.training.variants import UPDATES, VARIANTS, budget
from colift.benchmark.twin.libraries import require_jax
from colift.cli.completion import suites
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import AsJson, Jobs, check_new_folder, chosen_suite
from colift.cli.tables.admission import admission_words, criteria_table, means_table
from numpy.typing import NDArray

FEWEST_PAIRS, MOST_PAIRS = 3, 20


def admit_suite(
    suite: Annotated[
        str, typer.Argument(metavar="SUITE", help="The suite to test.", autocompletion=suites)
    ],
    pairs: Annotated[
        int,
        typer.Option(
            metavar="N", help="Pairs to train in the twin, for criterion d (extra: train)."
        ),
    ] = 0,
    people: Annotated[
        int | None,
        typer.Option(
            metavar="N", help="Play the first N people only, of the suite and of the control."
        ),
    ] = None,
    tune_policies: Annotated[
        bool,
        typer.Option(
            "--tune",
            help="Instead, tune the hand-made policies of the suite's task on training people.",
        ),
    ] = False,
    policies: Annotated[
        list[str] | None,
        typer.Option("--policy", metavar="NAME", help="With --tune: this policy only. Repeatable."),
    ] = None,
    updates: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            help="Updates of each network, for a suite with conditions or sessions (extra: "
            f"train).  [default: {UPDATES}, with sessions {session_kinds.UPDATES}]",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="New folder for the weights of these networks."),
    ] = None,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Test by six criteria whether the lifts of a suite need coordination.

    A suite with conditions is tested for whether there is something to infer, by two criteria,
    and one of sessions for whether it pays to remember the person, by five.

    Criteria a, d, e and f test whether a robot needs its partner, b and c whether it needs to know
    the person. Exit code 1 if the first is not shown, or is shown for the control.

    Example: colift admit agree-v1 --people 4
    """
    chosen = chosen_suite(suite, None, None, None)
    checked_jobs(jobs)
    if tune_policies:
        if pairs or any(each is not None for each in (people, updates, out)):
            raise InputError(
                "--tune takes none of --pairs, --people, --updates and --out: no lift of a suite "
                "counts, and no network is trained"
            )
        _tune(chosen, policies, jobs, as_json=as_json)
        return
    if policies:
        raise InputError("--policy is for --tune: a test of admission plays all policies")
    episodes = chosen if people is None else first_people(chosen, people)
    if episodes.session or needs_inference(episodes):
        if pairs:
            raise InputError("--pairs is for tasks with touch; this suite has none")
        check_new_folder("--out", out)
        if episodes.session:
            found = _remember(episodes, session_budget(updates), out, jobs)
        else:
            found = _infer(episodes, budget(updates), out, jobs)
        report(found, as_json=as_json)
        return
    if updates is not None or out is not None:
        raise InputError(
            f"--updates and --out are for suites with conditions or sessions; {suite} has none"
        )
    played = _cross_play(episodes.scenarios[0].task.name, pairs) if pairs else None
    control = None if suite == CONTROL else control_suite(people or CONTROL_PEOPLE)
    total = lifts_to_play(episodes) + (0 if control is None else lifts_to_play(control))
    with (
        reported_interrupt("a suite is tested with all policies or not at all"),
        workers("admit", total, jobs) as (pool, progress),
    ):
        beside = None
        if control is not None:
            beside = admission_of(control, executor=pool, progress=progress)
        found = admission_of(
            episodes, pairs=played, control=beside, executor=pool, progress=progress
        )
    report(found, as_json=as_json)


def report(found: Admission, *, as_json: bool) -> None:
    """Print a result; end with the exit code 1 if the suite is not admitted."""
    if as_json:
        print_json(found.plain())
    else:
        show(means_table(found), criteria_table(found), admission_words(found))
    if not found.passed:
        raise typer.Exit(1)


def _infer(suite: Suite, settings: ApgSettings, out: Path | None, jobs: int | None) -> Admission:
    """Train networks in the twin, and test a suite with conditions by them."""
    require_jax()
    from colift.benchmark.training.conditioned_lesson import ConditionedLesson
    from colift.benchmark.training.inferring import train_variants

    lesson = ConditionedLesson(suite)
    with job_bar("networks", len(VARIANTS) * settings.updates) as bar:
        networks = train_variants(lesson, settings, progress=bar.advance)
    if out is not None:
        write_networks(networks, out)
    total = inference.lifts_to_play(suite, len(networks))
    with (
        reported_interrupt("a suite is tested with all networks or not at all"),
        workers("admit", total, jobs) as (pool, progress),
    ):
        return inference_of(suite, networks, executor=pool, progress=progress)


def _remember(suite: Suite, settings: ApgSettings, out: Path | None, jobs: int | None) -> Admission:
    """Train networks in the twin, and test a suite of sessions by them."""
    remembering.check_people(suite)
    require_jax()
    from colift.benchmark.training.session_networks import train_kinds

    with job_bar("networks", len(get_args(Kind)) * settings.updates) as bar:
        networks = train_kinds(suite, settings, progress=bar.advance)
    if out is not None:
        write_weights({name: each._asdict() for name, each in networks.items()}, out)
    with (
        reported_interrupt("a suite is tested with all networks or not at all"),
        workers("admit", remembering.lifts_to_play(suite), jobs) as (pool, progress),
    ):
        return memory_of(suite, networks, executor=pool, progress=progress)


def _cross_play(task: str, count: int) -> NDArray[np.float64]:
    """Train pairs, and return the error of each person with each robot."""
    if not FEWEST_PAIRS <= count <= MOST_PAIRS:
        raise InputError(
            f"--pairs must be {FEWEST_PAIRS} to {MOST_PAIRS}, or 0 for none; got {count}"
        )
    settings = pair_settings(task)
    require_jax()
    from colift.benchmark.training.pairs import cross_play

    with job_bar("pairs", count * settings.updates) as bar:
        return cross_play(count, settings, bar.advance)


def _tune(suite: Suite, names: list[str] | None, jobs: int | None, *, as_json: bool) -> None:
    """Tune the policies of a suite's task, and print their errors before and after."""
    chosen = tunings(suite.scenarios[0].task.name, names)
    found: list[Tuned] = []
    with (
        reported_interrupt("a policy is tuned as a whole or not at all"),
        workers("tune", None, jobs) as (pool, progress),
    ):
        for name in chosen:
            found.append(tune(name, suite, executor=pool, progress=progress))
    if as_json:
        print_json({"tuned": [dataclasses.asdict(each) for each in found]})
        return
    rows = (
        (each.policy, f"{each.before_mm:.2f}", f"{each.after_mm:.2f}", each.settings or "as it is")
        for each in found
    )
    title = f"Policies of {suite.name}, tuned on training people; RMSE with others, mm"
    show(table(title, ("policy", "before", "after", left("settings")), rows))
