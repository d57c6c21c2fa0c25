"""``colift nao run``: a policy on a robot."""

import json
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from ...agents.hardware.loop import LoopSettings
from ...agents.hardware.operator import StopButton, armed, await_enter
from ...agents.hardware.record import Record
from ...agents.hardware.recording import Recording, write_recording
from ...agents.hardware.session import Session
from ...agents.hardware.stops import StopTrialError
from ...agents.hardware.trial_end import AfterDuration, AfterLift
from ...benchmark.agent_spec import AgentSpec
from ...benchmark.bundle import check_target, results, write_bundle
from ...benchmark.episode import policy_seed
from ...benchmark.hardware.timing import timing_report
from ...benchmark.hardware.trial import episode, hardware_run, hardware_suite
from ..policies import AUTO, HELP, choose_policy
from ..tables import results_table, standing
from .connections import WORLD, layout_of, open_place
from .reports import timing_table


def run(
    policy: Annotated[str, typer.Argument(help=HELP)],
    robot: Annotated[
        str,
        typer.Option(
            metavar="URL",
            help="Where the robot's NAOqi listens; or world[:BEHAVIOUR[/SUBJECT]], a laboratory "
            "that is simulated here, as fast as it goes, with a motion capture of its own.",
        ),
    ] = "tcp://127.0.0.1:9559",
    mocap: Annotated[str, typer.Option(metavar="lsl:NAME", help="The motion capture.")] = (
        "lsl:colift"
    ),
    trials: Annotated[int, typer.Option(metavar="N", help="How many lifts.", min=1)] = 10,
    control_period: Annotated[
        float, typer.Option(metavar="S", help="Time between two decisions.")
    ] = 0.1,
    latency: Annotated[
        float,
        typer.Option(metavar="S", help="From a frame to the hands' move, at least."),
    ] = 0.1,
    duration: Annotated[
        float | None,
        typer.Option(metavar="S", help="Length of a trial; default: until the table is down."),
    ] = None,
    person: Annotated[str, typer.Option(help="Who lifts, for the tables.")] = "person",
    human_markers: Annotated[str, typer.Option(help="Markers at the human's end.")] = "H1,H2",
    robot_markers: Annotated[str, typer.Option(help="Markers at the robot's end.")] = "R1,R2",
    up: Annotated[str, typer.Option(help="The stream's axis that points up.")] = "Z",
    isolation: Annotated[
        str,
        typer.Option(
            help="What keeps the policy apart: auto (a sandbox, unless it is colift's own), none, "
            "bubblewrap, landlock or limits."
        ),
    ] = AUTO,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Compute and log commands, and move nothing.")
    ] = False,
    yes: Annotated[
        bool, typer.Option("--yes", help="Do not wait for the operator's confirmations.")
    ] = False,
    record: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Where to write each trial as a CSV file.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Where to write the result bundle.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print results.json alone, and nothing else.")
    ] = False,
) -> None:
    """Let a policy lift with a person, and score it; Ctrl-C or Enter stops everything.

    Exit codes: 0 done, 2 wrong usage or set-up, 10 operator, 11 robot lost, 12 motion capture lost,
    13 motion capture not plausible, 14 policy, 15 motors.
    """
    spec = choose_policy(policy, isolation)
    spec.check()
    settings = LoopSettings(period=control_period, latency=latency)
    layout = layout_of(human_markers, robot_markers, up)
    name = "NAO trials" + (" (simulated)" if robot.startswith(WORLD) else "")
    name += " (dry run)" if dry_run else ""
    suite = hardware_suite(name, person, trials, period=control_period, latency=latency)
    if out is not None:
        check_target(out)
    if record is not None:
        record.mkdir(parents=True, exist_ok=True)
    button = StopButton()

    def confirm(line: str) -> None:
        _tell(line)
        if not unattended:
            _tell("  Enter when ready, Ctrl-C to stop.")
            await_enter(button)

    place = open_place(robot, mocap, layout, button)
    unattended = yes or dry_run or place.simulated
    session = Session(
        arm=place.arm,
        capture=place.capture,
        clock=place.clock,
        tell=_tell,
        confirm=confirm,
        button=button,
        dry=dry_run,
        asked_by=place.asked_by,
    )
    records: list[Record] = []
    stopped: StopTrialError | None = None
    try:
        with armed(button):
            for played in _trials(session, spec, trials, settings, duration):
                records.append(played)
                if record is not None:
                    write_recording(
                        record / f"lift-{len(records):02}.csv",
                        Recording(
                            policy=policy,
                            limits=place.arm.limits,
                            weight_offset=place.arm.weight_offset,
                            dry=dry_run,
                            record=played,
                        ),
                    )
    except StopTrialError as stop:
        stopped = stop
        session.stop(stop)
    finally:
        if not dry_run:
            _release(session, wait=not unattended)
        place.capture.close()
    if records:
        episodes = [
            episode(played, person=person, number=number) for number, played in enumerate(records)
        ]
        done = hardware_run(spec.name, spec.digest(), suite, episodes, spec.isolation)
        content = results(done, {})
        content["hardware"] = {
            "robot": robot,
            "motion_capture": place.capture.info,
            "dry_run": dry_run,
            "timing": timing_report(records),
        }
        if out is not None:
            write_bundle(out, done, content)
        _show(content, out, as_json)
    if stopped is not None:
        raise typer.Exit(int(stopped.stop))


def _trials(
    session: Session,
    spec: AgentSpec,
    trials: int,
    settings: LoopSettings,
    duration: float | None,
) -> Iterator[Record]:
    """Set up, and yield one trial after the other; raise after one that was stopped."""
    session.set_up()
    for number in range(1, trials + 1):
        end = AfterLift() if duration is None else AfterDuration(duration=duration)
        played = session.play(
            spec.agent(), policy_seed(), number=number, settings=settings, end=end
        )
        yield played
        if played.stop is not None:
            raise StopTrialError(played.stop, played.reason)
        _tell(f"lift {number} of {trials}: {len(played.steps)} steps")


def _release(session: Session, *, wait: bool) -> None:
    """Let the arms go limp when the operator has taken the table."""
    _tell("Take the table out of the hands: the arms go limp.")
    if wait:
        _tell("  Enter when it is out.")
        with suppress(KeyboardInterrupt):
            sys.stdin.readline()
    session.finish()


def _tell(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _show(content: dict[str, Any], out: Path | None, as_json: bool) -> None:
    """Print the results."""
    if as_json:
        print(json.dumps(content, indent=2, allow_nan=False))
        return
    console = Console()
    console.print(results_table(content))
    console.print(standing(content), highlight=False)
    console.print(timing_table(content["hardware"]["timing"]))
    if out is not None:
        console.print(f"Result bundle: {out}", highlight=False, soft_wrap=True)
