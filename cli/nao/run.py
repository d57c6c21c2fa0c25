"""``colift nao run``: trials of a policy on a robot."""

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, Final

import typer
from colift.agents.hardware.claim import claimed
from colift.agents.hardware.loop import LoopSettings
from colift.agents.hardware.operator import (
    HANDOVER,
    StopButton,
    armed,
    await_enter,
    await_table_out,
)
from colift.agents.hardware.session import Session
from colift.agents.hardware.stops import StopTrialError
from colift.agents.hardware.terminal import tell, watched
from colift.agents.hardware.trial_end import AfterDuration, AfterLift
from colift.agents.hardware.trial_log import LoggedTrial, TrialLog, write_trial
from colift.agents.hardware.watchdog import guarded
from colift.agents.spec import AUTO, AgentSpec
from colift.agents.submissions.choice import checked_policy
from colift.base.errors import InputError
from colift.benchmark.bundle import check_bundle_folder, is_bundle, results, write_bundle
from colift.benchmark.bundle.files import HARDWARE
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.execution.runner import Run
from colift.benchmark.hardware.timing import timing_report
from colift.benchmark.hardware.trial import episode, hardware_run, hardware_suite
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tables.printing import counted, show
from colift.benchmark.tables.results_table import results_table, results_text, timing_table
from colift.cli.document import print_json
from colift.cli.nao.connections import (
    URL,
    WORLD,
    HumanMarkers,
    MotionCapture,
    Place,
    RobotMarkers,
    UpAxis,
    describe_robot,
    describe_stream,
    layout_of,
    open_place,
)
from colift.cli.options import PERIOD_OPTION, AsJson, PolicyIsolation, PolicyName, check_folder
from colift.cli.remedies import naming

NUMBERED: Final = re.compile(r"lift-(\d+)\.csv")
"""Names of recorded trials."""


def run_on_robot(
    policy: PolicyName,
    robot: Annotated[
        str,
        typer.Option(
            metavar="URL",
            help="Address of the robot's NAOqi; or 'world' or 'world:BEHAVIOUR/SUBJECT' for a "
            "simulated laboratory with its own motion capture, faster than real time.",
        ),
    ] = URL,
    mocap: MotionCapture = "lsl:colift",
    trials: Annotated[int, typer.Option(metavar="N", help="Number of lifts.", min=1)] = 10,
    control_period: Annotated[float, PERIOD_OPTION] = 0.1,
    latency: Annotated[
        float,
        typer.Option(
            metavar="S", help="Shortest time from a frame to the motion of the hands, in seconds."
        ),
    ] = 0.1,
    duration: Annotated[
        float | None,
        typer.Option(
            metavar="S", help="Duration of a trial, in seconds; default: until the table is down."
        ),
    ] = None,
    person: Annotated[
        str, typer.Option(metavar="NAME", help="Name of the person who lifts.")
    ] = "person",
    human_markers: HumanMarkers = "H1,H2",
    robot_markers: RobotMarkers = "R1,R2",
    up: UpAxis = "Z",
    isolation: PolicyIsolation = AUTO,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Compute and log commands without moving the robot.")
    ] = False,
    yes: Annotated[
        bool, typer.Option("--yes", help="Do not wait for the operator's confirmations.")
    ] = False,
    record: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder for a CSV file per trial; earlier trials in it are kept.",
        ),
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder for the result bundle.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Let a policy lift with a person, and score it; Ctrl-C or Enter stops the robot.

    Exit code 0: done; 2: wrong usage or set-up. A stopped trial: 10 by the operator or a hang-up,
    11 robot lost, 12 motion capture lost, 13 motion capture not plausible, 14 by the policy, 15 by
    the motors or another program that commands the robot, 16 by a pause of this computer.

    Example: colift nao run blend --trials 3 --robot world:smooth/S1 --record trials
    """
    spec = checked_policy(policy, isolation)
    settings = LoopSettings(period=control_period, latency=latency)
    layout = layout_of(human_markers, robot_markers, up)
    name = "NAO trials" + (" (simulated)" if robot.startswith(WORLD) else "")
    name += " (dry run)" if dry_run else ""
    suite = hardware_suite(name, person, trials, period=control_period, latency=latency)
    if out is not None:
        with naming("--out"):
            check_bundle_folder(out)
            _check_empty(out)
    first = 1 if record is None else _first_number(record)
    button = StopButton()

    def confirm(line: str) -> None:
        tell(line)
        if not unattended:
            tell("  Enter when ready, Ctrl-C to stop.")
            with naming("confirmation", "--yes confirms in advance"):
                await_enter(button)

    place = open_place(robot, mocap, layout, button)
    unattended = yes or dry_run or place.simulated
    if not place.simulated:
        tell(f"robot: {describe_robot(place.arm.session)}")
        tell(f"motion capture: {describe_stream(place.capture.info)}")
    session = Session(
        arm=place.arm,
        capture=place.capture,
        clock=place.clock,
        tell=tell,
        confirm=confirm,
        button=button,
        dry=dry_run,
        asked_by=place.asked_by,
    )
    records: list[TrialLog] = []
    ended: Exception | None = None
    about = {"robot": robot, "motion_capture": place.capture.info, "dry_run": dry_run}
    # Also the report is made with the button armed: a second Ctrl-C does not change the exit code.
    with armed(button), watched(button):
        try:
            with _alone(place, dry_run):
                try:
                    for played in _trials(session, spec, trials, settings, duration):
                        records.append(played)
                        if record is not None:
                            number = first + len(records) - 1
                            _record(record, policy, session, played, number=number)
                except StopTrialError as stop:
                    session.stop(stop)
                    raise
                finally:
                    if not dry_run:
                        session.finish(_taken_out(place, button, unattended))
        except Exception as error:
            # The earlier lifts are still reported.
            ended = error
        finally:
            place.capture.close()
        try:
            if records:
                _report(_scored(spec, suite, records, person), records, about, out, as_json)
        except Exception as error:
            # A stopped lift sets the exit code, whatever else fails.
            if ended is None:
                raise
            tell(f"there is no report: {error}")
    if isinstance(ended, StopTrialError):
        raise typer.Exit(int(ended.stop))
    if ended is not None:
        raise ended


@contextmanager
def _alone(place: Place, dry_run: bool) -> Iterator[None]:
    """Claim the robot for this command, under a watchdog, if it is real and moves."""
    if dry_run or place.simulated:
        yield
        return
    with claimed(place.arm, place.clock) as claim, guarded(place.arm, claim):
        yield


def _trials(
    session: Session,
    spec: AgentSpec,
    trials: int,
    settings: LoopSettings,
    duration: float | None,
) -> Iterator[TrialLog]:
    """Set up, and yield each trial; raise after one that was stopped."""
    session.set_up()
    for number in range(1, trials + 1):
        end = AfterLift() if duration is None else AfterDuration(duration=duration)
        played = session.play(
            spec.agent(), policy_seed(), number=number, settings=settings, end=end
        )
        yield played
        if played.stop is not None:
            raise StopTrialError(played.stop, played.reason)
        tell(f"lift {number} of {trials}: {counted(len(played.steps), 'step')}")


def _check_empty(folder: Path) -> None:
    """Refuse a folder with a bundle, even of a stopped run: a robot's trials cannot be repeated."""
    if is_bundle(folder):
        raise InputError(f"{folder} holds the result bundle of earlier trials; name a new folder")


def _first_number(folder: Path) -> int:
    """Make the folder of trials, and return the number after the last trial in it."""
    check_folder("--record", folder)
    found = (NUMBERED.fullmatch(path.name) for path in folder.iterdir())
    return 1 + max((int(each[1]) for each in found if each), default=0)


def _record(folder: Path, policy: str, session: Session, played: TrialLog, *, number: int) -> None:
    """Write a trial as a CSV file."""
    write_trial(
        folder / f"lift-{number:02}.csv",
        LoggedTrial(
            policy=policy,
            limits=session.limits,
            weight_offset=session.arm.weight_offset,
            dry=session.dry,
            log=played,
        ),
    )


def _scored(spec: AgentSpec, suite: Suite, records: Sequence[TrialLog], person: str) -> Run:
    """Return the trials as a run."""
    episodes = [
        episode(played, person=person, number=number) for number, played in enumerate(records)
    ]
    return hardware_run(spec.name, spec.digest(), suite, episodes, spec.isolation)


def _taken_out(place: Place, button: StopButton, unattended: bool) -> Callable[[], None]:
    """Return what waits until the table is out of the hands; in a simulation, it is at once."""

    def wait() -> None:
        if place.simulated:
            return
        if not unattended:
            tell("  Enter when it is out.")
        if unattended or not button.at_terminal:
            tell(f"  They do in {HANDOVER:g} s by themselves.")
        await_table_out(button, attended=not unattended)

    return wait


def _report(
    done: Run, records: Sequence[TrialLog], about: dict[str, Any], out: Path | None, as_json: bool
) -> None:
    """Write the result bundle, and print the results."""
    content, timing = results(done, {}), timing_report(records)
    plain = {**content.plain(), HARDWARE: {**about, "timing": timing}}
    if out is not None:
        write_bundle(out, done, plain)
    if as_json:
        print_json(plain)
        return
    show(results_table(content, done.suite.metrics), results_text(content, done.suite.metrics))
    show(timing_table(timing))
    if out is not None:
        print(f"Result bundle: {out}")
