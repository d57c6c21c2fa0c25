"""The help of every command: it is shown, and nothing of it is taken for markup and swallowed."""

import re

import pytest
import typer
from colift.cli.commands import COMMANDS
from colift.cli.main import app
from typer.testing import CliRunner


def commands(command, path=()):
    """Yield the path to each command of the command line, groups included."""
    yield path, command
    if hasattr(command, "list_commands"):
        context = typer.Context(command)
        for name in command.list_commands(context):
            yield from commands(command.get_command(context, name), (*path, name))


ALL = dict(commands(typer.main.get_command(app)))


def letters(text):
    """Return a text without what the layout of a help page adds: spaces, lines and frames."""
    return re.sub(r"[\s│╭╮╰╯─]", "", text)


def test_every_command_is_walked():
    assert {("run",), ("nao", "run"), ("nao", "emulate"), ("queue", "list")} <= set(ALL)
    assert len(ALL) > 40


@pytest.mark.parametrize("path", ALL, ids=" ".join)
def test_the_help_of_a_command_is_shown_in_full(path):
    # On a page so wide that no cell of its tables is broken into lines.
    wide = {"COLUMNS": "1000"}
    shown = CliRunner().invoke(app, [*path, "--help"], prog_name="colift", env=wide)
    assert shown.exit_code == 0, shown.exception
    assert "Usage: " in shown.output
    assert ALL[path].help
    page = letters(shown.output)
    for parameter in ALL[path].params:
        assert parameter.help
        assert letters(parameter.help) in page
    assert re.findall(r"<[a-z]+[^<>]*>", shown.output) == []  # A type; values have names.


def test_help_names_every_command(colift):
    done = colift("--help")
    assert done.returncode == 0
    assert [name for name in COMMANDS if f" {name} " not in done.stdout] == []
