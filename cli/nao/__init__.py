"""``colift nao``: a policy on a real NAO, or on an emulated one."""

import typer

from . import calibrate, check, emulate, replay, run

app = typer.Typer(
    help="Take a policy to a real NAO and a motion-capture system, or to emulated ones.",
    no_args_is_help=True,
)
app.command()(run.run)
app.command()(check.check)
app.command()(emulate.emulate)
app.command()(replay.replay)
app.command()(calibrate.calibrate)
