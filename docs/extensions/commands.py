"""The directive ``commands``: the commands of the program, with their arguments and options."""

import re
from collections.abc import Iterator
from typing import Any, Final

from colift.cli.commands import PANELS, load
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

CODE: Final = re.compile(r"('colift [^']*'|(?<![\w-])--[a-z][a-z-]*)")
"""A command or an option in a help text."""


class Commands(SphinxDirective):
    """The commands of one panel of ``colift --help``, a section each."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """Return the sections."""
        panel = self.arguments[0]
        if panel not in PANELS:
            raise self.severe(f"no panel {panel!r}; there are {', '.join(PANELS)}")
        return [
            self._section(path, command)
            for name in PANELS[panel]
            for path, command in _commands(f"colift {name}", load(name))
        ]

    def _section(self, path: str, command: Any) -> nodes.section:
        """Return the section of a command: its help, its usage, a table of its parameters."""
        section = nodes.section(ids=[path.replace(" ", "-")])
        self.state.document.note_explicit_target(section)
        section += nodes.title(path, path)
        for paragraph in (command.help or "").split("\n\n"):
            section += self._parsed(paragraph)
        parts = [piece for parameter in command.params for piece in _usage(parameter)]
        usage = " ".join([path, *parts])
        section += nodes.literal_block(usage, usage, language="text")
        rows = [row for row in map(_row, command.params) if row]
        if rows:
            section += self._table(rows)
        return section

    def _parsed(self, text: str) -> nodes.paragraph:
        """Return a paragraph in which options and quoted commands are code."""
        paragraph = nodes.paragraph()
        for index, part in enumerate(CODE.split(" ".join(text.split()))):
            word = part.strip("'")
            paragraph += nodes.literal(word, word) if index % 2 else nodes.Text(part)
        return paragraph

    def _table(self, rows: list[tuple[str, str]]) -> nodes.table:
        """Return a table of parameters and their meaning."""
        group = nodes.tgroup(cols=2)
        group += [nodes.colspec(colwidth=30), nodes.colspec(colwidth=70)]
        body = nodes.tbody()
        for name, meaning in rows:
            left = nodes.paragraph("", "", nodes.literal(name, name))
            cells = nodes.entry("", left), nodes.entry("", self._parsed(meaning))
            body += nodes.row("", *cells)
        group += body
        return nodes.table("", group, classes=["parameters"])


def _commands(path: str, command: Any) -> Iterator[tuple[str, Any]]:
    """Yield a command, or those of a group, each with the words that call it."""
    inner = getattr(command, "commands", None)
    if inner is None:
        yield path, command
    else:
        for name, each in inner.items():
            yield from _commands(f"{path} {name}", each)


def _usage(parameter: Any) -> Iterator[str]:
    """Yield the place of a parameter in a command line, if it needs one."""
    if parameter.param_type_name == "argument":
        name = parameter.metavar or parameter.human_readable_name
        name += "..." if parameter.nargs == -1 else ""
        yield name if parameter.required else f"[{name}]"
    elif parameter.required:
        yield f"{parameter.opts[0]} {parameter.metavar or 'VALUE'}"


def _row(parameter: Any) -> tuple[str, str] | None:
    """Return a parameter as it is written, and its meaning; nothing for ``--help``."""
    if parameter.name == "help" or getattr(parameter, "hidden", False):
        return None
    if parameter.param_type_name == "argument":
        return parameter.metavar or parameter.human_readable_name, parameter.help or ""
    name = ", ".join([*parameter.opts, *parameter.secondary_opts])
    if not parameter.is_flag:
        name += f" {parameter.metavar or 'VALUE'}"
    meaning = parameter.help or ""
    shown = isinstance(parameter.default, str | int | float) and not parameter.is_flag
    if shown and str(parameter.default) and parameter.show_default:
        meaning += f" Default: {parameter.default}."
    return name, meaning


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
