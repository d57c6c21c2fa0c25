"""The commands, each imported when it is called."""

import ast
import importlib
import importlib.util
import inspect
from collections.abc import Iterator, Mapping
from itertools import dropwhile
from typing import Any, Final

import typer
from colift.base.errors import InputError
from colift.cli.loading import Loading
from typer.core import TyperCommand, TyperGroup

PANELS: Final[Mapping[str, Mapping[str, str]]] = {
    "Use": {
        "run": "run:run",
        "compare": "compare:compare_policies",
        "summary": "summary:summarise_bundles",
        "channels": "channels:measure_channels",
        "recordings": "recordings:make_recordings",
        "validity": "validity:validity",
        "pairs": "pairs:pairs",
        "list": "listing:list_all",
        "inspect": "inspect:inspect_bundle",
        "render": "render:render_episode",
        "play": "play:play",
        "demonstrate": "demonstrate:demonstrate_lifts",
        "export": "export:export_lifts",
        "paper": "paper:paper",
    },
    "Submit a policy": {
        "new": "new:new",
        "train": "train:app",
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
        "statistics": "statistics:check_statistics",
        "references": "references:references",
        "ablate": "references:ablate_policies",
        "sweep": "references:sweep_rates",
        "bench": "bench:bench",
        "figures": "figures:figures",
    },
}
"""The commands by panel of ``colift --help``, each ``module:attribute``: a function, or an app with
commands of its own."""

COMMANDS: Final = {name: place for panel in PANELS.values() for name, place in panel.items()}


OTHER_WORDS: Final[Mapping[str, str]] = {
    "evaluate": "run",
    "score": "run",
    "test": "check",
    "draw": "render",
    "plot": "render",
    "init": "new",
}
"""Words for what a command does that are the name of none, with the command."""


class Commands(TyperGroup):
    """The commands of :data:`COMMANDS`.

    Each is loaded when it is called: all libraries together take seconds to import. Lists of
    commands, in a help text or a completion, load none.
    """

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**{**attributes, "commands": _Listed()})

    def list_commands(self, ctx: Any) -> list[str]:
        """Return the names."""
        return list(COMMANDS)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the arguments; ``help COMMAND`` is ``COMMAND --help``."""
        if args[:1] == ["help"]:
            args = [*args[1:], "--help"]
        if not ctx.resilient_parsing:
            return super().parse_args(ctx, args)
        # A completion needs no options of colift itself, and Typer takes long to read their values.
        own, self.params, self.add_help_option = self.params, [], False
        try:
            return super().parse_args(ctx, [*dropwhile(_is_option, args)])
        finally:
            self.params, self.add_help_option = own, True

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the name, the loaded command and its arguments."""
        meant = OTHER_WORDS.get(args[0])
        if meant is not None and not ctx.resilient_parsing:
            raise InputError(f"no command {args[0]!r}: 'colift {meant}' does this")
        name, command, rest = super().resolve_command(ctx, args)
        return name, command if name is None else load(name), rest

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write a section for each panel."""
        for panel, names in PANELS.items():
            _list(formatter, panel, {name: self.commands[name] for name in names})

    def shell_complete(self, ctx: Any, incomplete: str) -> list[Any]:
        """Return the commands that begin with a text, by name alone.

        For shells that would show their help, Typer imports Rich.
        """
        found = super().shell_complete(ctx, incomplete)
        for each in found:
            each.help = None
        return found


class _Listed(Mapping[str, Any]):
    """Commands by name, with the first paragraph of their help and without anything to run."""

    def __getitem__(self, name: str) -> Any:
        return TyperCommand(name, help=first_paragraph(COMMANDS[name]))

    def __iter__(self) -> Iterator[str]:
        return iter(COMMANDS)

    def __len__(self) -> int:
        return len(COMMANDS)


def load(name: str) -> Any:
    """Import the command of a name and return it as Typer's."""
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
    _plain(command)
    command.name = name
    return command


def first_paragraph(place: str) -> str:
    """Return the first paragraph of a command's help from its source, which is not run.

    Parameters
    ----------
    place
        ``module:attribute``: a function, whose docstring it is; an app, ``typer.Typer(help=...)``;
        or what the module imports from another one of this folder.
    """
    module, _, attribute = place.partition(":")
    for statement in ast.parse(_source(module)).body:
        match statement:
            case ast.FunctionDef(name=name) if name == attribute:
                return (ast.get_docstring(statement) or "").partition("\n\n")[0].replace("\n", " ")
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Call(keywords=keywords)) if (
                name == attribute
            ):
                return str(
                    next(ast.literal_eval(each.value) for each in keywords if each.arg == "help")
                )
            case ast.ImportFrom(module=str(other), names=names) if any(
                each.name == attribute for each in names
            ):
                return first_paragraph(f"{other.removeprefix(f'{__package__}.')}:{attribute}")
    raise LookupError(f"no {attribute} in {module}")


def _source(module: str) -> str:
    spec = importlib.util.find_spec(f".{module}", __package__)
    source = getattr(spec and spec.loader, "get_source", lambda name: None)(spec and spec.name)
    if source is None:
        raise LookupError(f"no source of {module}")
    return str(source)


def _is_option(argument: str) -> bool:
    return argument.startswith("-")


def _plain(command: Any) -> None:
    """Let the help of a command be plain text without types, whose paragraphs the terminal wraps.

    Rich would take longer to import than the help to print, and draw boxes into files. Names of
    arguments show what they are; Typer would print ``<str>`` beside them. The last paragraph,
    ``Example: colift run blend``, becomes the epilog: the command line alone.
    """
    command.rich_markup_mode = None
    words, _, example = inspect.cleandoc(command.help or "").partition("\n\nExample: ")
    command.help = "\n\n".join(" ".join(each.split()) for each in words.split("\n\n"))
    command.epilog = example
    command.format_epilog = lambda ctx, formatter: _show_example(formatter, example)
    for parameter in command.params:
        if parameter.param_type_name == "argument":
            parameter.display_type_rich = lambda ctx: ""
    inner = getattr(command, "commands", None)
    if inner:
        for each in inner.values():
            _plain(each)
        command.format_commands = lambda ctx, formatter: _list(formatter, "Commands", inner)


def _show_example(formatter: Any, example: str) -> None:
    """Write the section of a command's example, if it has one; its line is not wrapped."""
    if example:
        with formatter.section("Example"):
            formatter.write_text(f"\b\n{example}")


def _list(formatter: Any, title: str, commands: Mapping[str, Any]) -> None:
    """Write a section of commands, each with the first paragraph of its help."""
    with formatter.section(title):
        formatter.write_dl(
            [(name, each.help.partition("\n\n")[0]) for name, each in commands.items()]
        )
