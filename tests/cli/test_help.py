"""The help of every command: it is shown, and nothing of it is taken for markup and swallowed."""

import os
import re
import resource
import shlex
import subprocess
import sys
from importlib.util import find_spec

import pytest
import typer
from colift.cli.commands import COMMANDS, load
from colift.cli.program import app
from typer.testing import CliRunner


def commands(command, path):
    """Yield the path to a command, and to each one in it."""
    yield path, command
    for name, inner in getattr(command, "commands", {}).items():
        yield from commands(inner, (*path, name))


ALL = {(): typer.main.get_command(app)}
ALL |= {path: each for name in COMMANDS for path, each in commands(load(name), (name,))}


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
        assert (letters(parameter.help) in page) is not parameter.hidden
    assert re.findall(r"<[a-z]+[^<>]*>", shown.output) == []  # A type; values have names.


LEAVES = {path: each for path, each in ALL.items() if path and not hasattr(each, "commands")}


@pytest.mark.parametrize("path", LEAVES, ids=" ".join)
def test_the_example_in_the_help_of_a_command_is_one_that_it_takes(path):
    command = LEAVES[path]
    program, *words = shlex.split(command.epilog)
    assert (program, *words[: len(path)]) == ("colift", *path)
    command.make_context(" ".join(path), words[len(path) :])
    assert f"\nExample:\n  {command.epilog}\n" in CliRunner().invoke(app, [*path, "--help"]).output


RUN = (
    ("list",), ("new",), ("check",), ("run",), ("verify",), ("export",), ("render",), ("compare",),
    ("submit",), ("board",), ("token", "add"), ("token", "list"), ("token", "revoke"),
    ("queue", "list"), ("row", "withdraw"), ("row", "reinstate"), ("nao", "run"), ("nao", "replay"),
)  # fmt: skip
"""Commands whose examples take seconds, in an order in which each finds what it needs."""


@pytest.mark.slow
def test_the_examples_do_what_they_say(colift, tmp_path):
    season = ("season", "begin", "short", "--suite", "quick-v1", "--no-own", "--board", "board")
    assert colift(*season, cwd=tmp_path).returncode == 0
    for path in RUN:
        done = colift(*shlex.split(LEAVES[path].epilog)[1:], cwd=tmp_path)
        assert done.returncode == 0, (path, done.stderr)
        if path == ("new",):
            manifest = tmp_path / "mine" / "policy.toml"
            manifest.write_text(manifest.read_text().replace("Your Name", "Ada"))
    made = {each.name for each in tmp_path.iterdir()}
    assert {"mine", "bundle", "minari", "lift.png", "board", "trials"} <= made


def test_help_names_every_command(colift):
    done = colift("--help")
    assert done.returncode == 0
    assert [name for name in COMMANDS if f" {name} " not in done.stdout] == []


def test_the_list_shows_the_first_paragraph_of_each_help_text():
    listed = typer.main.get_command(app)
    context = typer.Context(listed)
    for name in COMMANDS:
        assert listed.get_command(context, name).help == load(name).help.partition("\n\n")[0]


def program(*arguments, **environment):
    """Run the program; return what it printed, and its processor time [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [sys.executable, "-m", "colift", *arguments],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, sum(getattr(after, it) - getattr(before, it) for it in ("ru_utime", "ru_stime"))


def imported(*arguments, **environment):
    """Return the modules that a command imports."""
    done, _ = program(*arguments, **environment, PYTHONPROFILEIMPORTTIME="1")
    return {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}


TAB = {"_COLIFT_COMPLETE": "complete_bash", "COMP_CWORD": "1"}
FULL = {"pybullet", "scipy", "jax", "matplotlib", "sqlalchemy", "onnxruntime"}


@pytest.mark.parametrize("words", ["", "ru"])
@pytest.mark.parametrize("arguments", [("--help",), ()])
def test_lists_of_commands_load_none(words, arguments):
    environment = {} if arguments else {**TAB, "COMP_WORDS": f"colift {words}"}
    found = imported(*arguments, **environment)
    assert "typer" in found
    own = {f"colift.cli.{place.partition(':')[0]}" for place in COMMANDS.values()}
    assert found & (own | FULL | {"numpy", "rich.console"}) == set()


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_each_shell_completes_commands(shell):
    words = {"COMP_WORDS": "colift ver", "_TYPER_COMPLETE_ARGS": "colift ver", "COMP_CWORD": "1"}
    environment = {**words, "_COLIFT_COMPLETE": f"complete_{shell}"}
    done, _ = program(**environment, _TYPER_COMPLETE_FISH_ACTION="get-args")
    assert "verify" in done.stdout


def test_the_help_and_the_completion_of_run_load_no_engine():
    assert imported("run", "--help") & FULL == set()
    words = {**TAB, "COMP_WORDS": "colift run blend --suite q", "COMP_CWORD": "4"}
    assert imported(**words) & FULL == set()


@pytest.mark.slow
def test_a_run_loads_neither_robots_nor_live_lifts_nor_trainings():
    found = imported("run", "copy", "--behaviour", "smooth", "--seeds", "0:1", "--jobs", "1")
    for folder in ("agents.hardware", "benchmark.training", "benchmark.twin", "play"):
        assert find_spec(f"colift.{folder}")
        assert [name for name in found if name.startswith(f"colift.{folder}")] == []
    assert found & (FULL - {"pybullet"}) == set()


def test_help_as_a_word_is_the_option():
    assert program("help", "render")[0].stdout == program("render", "--help")[0].stdout


def test_a_word_for_what_a_command_does_names_it(colift):
    done = colift("evaluate", "blend")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "error: no command 'evaluate': 'colift run' does this\n"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (
            ("render", "blend"),
            "missing option '--out' ('colift render --help' explains the usage)",
        ),
        (("nao",), "a command is missing; 'colift nao --help' lists them"),
        (("nao", "rnu"), "no such command 'rnu'. Did you mean 'run'?"),
        (("run",), "missing argument 'POLICY'"),
        (("run", "blend", "--jobs", "two"), "invalid value for '--jobs'"),
    ],
)
def test_errors_have_one_form(colift, arguments, told):
    done = colift(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"error: {told}")
    assert done.stderr.count("\n") == 1
