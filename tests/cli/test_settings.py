"""Options from the fields of a dataclass."""

from dataclasses import dataclass
from typing import Literal

import typer
from colift.cli.settings import with_settings
from typer.testing import CliRunner


@dataclass(frozen=True, kw_only=True)
class Cup:
    milk: int = 2
    """Millilitres of milk. They are poured first."""


@dataclass(frozen=True, kw_only=True)
class Tea(Cup):
    leaf: str = "assam"
    """Leaf."""
    heat: float = 95.0
    """Temperature, in °C."""
    milky: Literal["", "first", "last"] = ""
    """When the milk is poured."""
    spoon: bool = True
    """Whether there is a spoon."""


def app(made: list) -> typer.Typer:
    def brew(*, pots: int = 1, settings: Tea, quietly: bool = False) -> None:
        """Brew tea."""
        made.append((pots, settings, quietly))

    told = typer.Typer(rich_markup_mode=None)
    names = ("milk", "heat", "leaf", "milky")
    told.command()(with_settings(brew, Tea, *names, heat={"metavar": "C"}))
    return told


def test_each_setting_is_an_option_with_its_default_and_the_first_sentence_of_its_docstring():
    shown = CliRunner().invoke(app([]), ["--help"]).stdout
    lines = [" ".join(line.split()) for line in shown.splitlines()]
    assert "Brew tea." in lines
    start = next(i for i, line in enumerate(lines) if line.startswith("--pots"))
    assert lines[start + 1 : start + 5] == [
        "--milk N Millilitres of milk. [default: 2]",
        "--heat C Temperature, in °C. [default: 95.0]",
        "--leaf NAME Leaf. [default: assam]",
        "--milky first|last When the milk is poured.",
    ]
    assert "spoon" not in shown


def test_the_command_gets_the_settings():
    made = []
    given = ["--milk", "7", "--pots", "3", "--heat", "80", "--milky", "last"]
    CliRunner().invoke(app(made), given)
    assert made == [(3, Tea(milk=7, heat=80.0, milky="last"), False)]
