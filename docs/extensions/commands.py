"""The pages of the commands: one for each, from the program itself, and lists of them by panel.

``commands PANEL`` is the table of a panel of ``colift --help``; ``command NAME`` the content of a
command's page, which is written to ``generated/commands`` before the build.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from colift.cli.commands import COMMANDS, PANELS, first_paragraph, load
from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

FOLDER: Final = "generated/commands"

CODE: Final = re.compile(r"('colift [^']*'|(?<![\w-])--[a-z][a-z-]*)")
"""A command or an option in a help text."""


class Commands(SphinxDirective):
    """The commands of one panel of ``colift --help``, each with a link to its page."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        panel = self.arguments[0]
        if panel not in PANELS:
            raise self.severe(f"no panel {panel!r}; there are {', '.join(PANELS)}")
        rows = [
            (self._link(name), _parsed(first_paragraph(place)))
            for name, place in PANELS[panel].items()
        ]
        return [_table(rows)]

    def _link(self, name: str) -> nodes.paragraph:
        """Return the name of a command as a link to its page."""
        text = f"colift {name}"
        link = pending_xref(
            text,
            nodes.literal(text, text),
            refdomain="std",
            reftype="doc",
            reftarget=f"/{FOLDER}/{name}",
            refexplicit=True,
            refwarn=True,
            refdoc=self.env.docname,
        )
        return nodes.paragraph("", "", link)


class Command(SphinxDirective):
    """What a command does, its usage, an example, and a table of its parameters.

    A command that has others gets a section for each.
    """

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the content of the page."""
        name = self.arguments[0]
        command = load(name)
        inner = getattr(command, "commands", {})
        return [
            *_content(f"colift {name}", command),
            *(self._section(f"colift {name} {each}", inner[each]) for each in inner),
        ]

    def _section(self, path: str, command: Any) -> nodes.section:
        section = nodes.section(ids=[path.replace(" ", "-")])
        self.state.document.note_explicit_target(section)
        section += nodes.title(path, path)
        section += _content(path, command)
        return section


def _content(path: str, command: Any) -> list[nodes.Node]:
    """Return the help of a command, its usage, its example and its parameters."""
    content: list[nodes.Node] = [_parsed(each) for each in (command.help or "").split("\n\n")]
    if hasattr(command, "commands"):
        return content
    parts = [piece for parameter in command.params for piece in _usage(parameter)]
    usage = f"Usage:   {' '.join([path, *parts])}\nExample: {command.epilog}"
    content.append(nodes.literal_block(usage, usage, language="text"))
    rows = [
        (nodes.paragraph("", "", nodes.literal(row[0], row[0])), _parsed(row[1]))
        for row in map(_row, command.params)
        if row
    ]
    return [*content, _table(rows)] if rows else content


def _parsed(text: str) -> nodes.paragraph:
    """Return a paragraph in which options and quoted commands are code."""
    paragraph = nodes.paragraph()
    for index, part in enumerate(CODE.split(" ".join(text.split()))):
        word = part.strip("'")
        paragraph += nodes.literal(word, word) if index % 2 else nodes.Text(part)
    return paragraph


def _table(rows: list[tuple[nodes.paragraph, nodes.paragraph]]) -> nodes.table:
    """Return a table of names and their meaning."""
    group = nodes.tgroup(cols=2)
    group += [nodes.colspec(colwidth=30), nodes.colspec(colwidth=70)]
    body = nodes.tbody()
    for row in rows:
        body += nodes.row("", *(nodes.entry("", cell) for cell in row))
    group += body
    return nodes.table("", group, classes=["parameters"])


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


def write_pages(app: Sphinx) -> None:
    """Write the pages that are not there yet, and remove those of former commands."""
    folder = Path(app.srcdir, FOLDER)
    folder.mkdir(parents=True, exist_ok=True)
    for page in folder.glob("*.rst"):
        if page.stem not in COMMANDS:
            page.unlink()
    for name in COMMANDS:
        title = f"colift {name}"
        text = f"{title}\n{'=' * len(title)}\n\n.. command:: {name}\n"
        page = folder / f"{name}.rst"
        if not page.exists() or page.read_text(encoding="utf-8") != text:
            page.write_text(text, encoding="utf-8")


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives, and write the pages before they are read."""
    app.add_directive("command", Command)
    app.add_directive("commands", Commands)
    app.connect("builder-inited", write_pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
