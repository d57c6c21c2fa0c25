"""The commands, each imported when it is called."""

import importlib
import inspect
from collections.abc import Iterator, Mapping
from typing import Any, Final

import typer
from typer.core import TyperGroup

from .start import Loading

PANELS: Final[Mapping[str, Mapping[str, str]]] = {
    "Use": {
        "run": "run:run",
        "compare": "compare:compare_policies",
        "summary": "summary:summarise_bundles",
        "channels": "channels:measure_channels",
        "validity": "validity:validity",
        "list": "listing:list_all",
        "render": "render:render_episode",
        "play": "play:play",
        "demonstrate": "demonstrate:demonstrate_lifts",
        "export": "export:export_lifts",
        "paper": "paper:paper",
    },
    "Submit a policy": {
        "new": "new:new",
        "train": "train_offline:app",
        "check": "check:check",
        "submit": "submit:submit_policy",
        "verify": "verify:verify_bundle",
    },
    "Run a board": {
        "serve": "serve:serve_board",
        "board": "board:board",
        "token": "token:app",
        "queue": "queue:app",
        "row": "row:app",
        "worker": "worker:worker",
        "season": "season:app",
    },
    "Use a robot": {"nao": "nao:app"},
    "Maintain colift": {
        "learn": "learn:app",
        "calibrate": "calibrate:calibrate",
        "baselines": "baselines:baselines",
        "admit": "admit:admit_suite",
        "practice": "practice:practice",
        "bounds": "bounds:bounds",
        "ablate": "bounds:ablate_policies",
        "sweep": "bounds:sweep_rates",
        "bench": "bench:bench",
        "figures": "figures:figures",
    },
}
"""The commands by panel of ``colift --help``, each ``module:attribute``: a function, or an app with
commands of its own."""

COMMANDS: Final = {name: place for panel in PANELS.values() for name, place in panel.items()}


class Commands(TyperGroup):
    """The commands of :data:`COMMANDS`.

    Each is loaded when it is used: all libraries together take seconds to import.
    """

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**{**attributes, "commands": _Loaded()})

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the options of ``colift`` itself."""
        return _untyped(super().get_params(ctx))


class _Loaded(Mapping[str, Any]):
    """Typer's commands by name, imported when they are looked up."""

    def __getitem__(self, name: str) -> Any:
        module, _, attribute = COMMANDS[name].partition(":")
        with Loading():
            found = getattr(importlib.import_module(f".{module}", __package__), attribute)
        command: Any
        if isinstance(found, typer.Typer):
            command = typer.main.get_group(found)
        else:
            app = typer.Typer(add_completion=False)
            app.command()(found)
            command = typer.main.get_command(app)
        _without_types(command)
        _flowing(command)
        command.name = name
        command.rich_help_panel = next(panel for panel, names in PANELS.items() if name in names)
        return command

    def __iter__(self) -> Iterator[str]:
        return iter(COMMANDS)

    def __len__(self) -> int:
        return len(COMMANDS)


def _without_types(command: Any) -> None:
    """Leave types out of a help text: a flag takes no value, an argument's name shows its type.

    Typer would print ``<bool>`` beside each flag and ``<list[str]>`` beside arguments.
    """
    for inner in getattr(command, "commands", {}).values():
        _without_types(inner)
    every = command.get_params
    command.get_params = lambda context: _untyped(every(context))


def _flowing(command: Any) -> None:
    """Join the lines of each paragraph of a help text: the terminal wraps them at its own width."""
    for inner in getattr(command, "commands", {}).values():
        _flowing(inner)
    paragraphs = inspect.cleandoc(command.help or "").split("\n\n")
    command.help = "\n\n".join(" ".join(each.split()) for each in paragraphs)


def _untyped(parameters: list[Any]) -> list[Any]:
    """Return the parameters of a command; flags and arguments have no type."""
    for parameter in parameters:
        if parameter.param_type_name == "argument" or parameter.is_flag:
            parameter.display_type_rich = lambda ctx: None
    return parameters
