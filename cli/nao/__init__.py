"""``colift nao``: a policy on a real NAO, or on an emulated one."""

import typer
from colift.cli.nao import calibrate, check, emulate, replay, run, watchdog

app = typer.Typer(
    help="Use a policy with a real NAO and a motion-capture system, or with emulated ones.",
    no_args_is_help=True,
)
app.command("run")(run.run_on_robot)
app.command("check")(check.check_setup)
app.command("watchdog")(watchdog.watch_robot)
app.command("emulate")(emulate.emulate)
app.command("replay")(replay.replay_recording)
app.command("calibrate")(calibrate.calibrate_setup)
