"""Recorded outputs of commands: numbers from them, and their tables as tables of the page.

``{figure}`references|0.360``` shows 0.360, and fails the build if ``figures/references.txt`` has
no 0.360. The directive ``result-table`` shows an output, or a part of it, with its command.
"""

import re
from pathlib import Path
from typing import Any, ClassVar, Final

from colift.benchmark.figures.registry import read_figures
from docutils import nodes
from docutils.parsers.rst import directives
from printed_tables import PrintedTable, read_output
from sphinx.application import Sphinx
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.docutils import SphinxDirective, SphinxRole

FOLDER: Final = "figures"
"""Folder of the recorded outputs and of their registry, in that of the pages."""

WIDTH: Final = 88
"""Longest line that fits a page, and longest title of a table [characters]."""

FOLDS: Final = "folds"
"""Class of an output whose long lines are sentences, which fold at the edge of the page."""


class Figure(SphinxRole):
    """A number of a recorded output."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """Return the number, if the output has it."""
        name, _, text = self.text.partition("|")
        path = Path(self.env.srcdir) / FOLDER / f"{name}.txt"
        self.env.note_dependency(path)
        if not path.is_file() or text not in path.read_text(encoding="utf-8"):
            problem = self.inliner.reporter.error(
                f"figures/{name}.txt has no {text!r}", line=self.lineno
            )
            return [self.inliner.problematic(self.rawtext, self.rawtext, problem)], [problem]
        return [nodes.Text(text)], []


class ResultTable(SphinxDirective):
    """The output of a registered figure: its tables, and the words beside them.

    The first part of an output on a page begins with its command. ``:start-at:`` is a text in the
    first line of the part that is shown, ``:end-before:`` one in the first line after it.
    """

    required_arguments = 1
    option_spec: ClassVar[dict[str, Any]] = {
        "start-at": directives.unchanged_required,
        "end-before": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        """Return the command, the tables with their titles, and the paragraphs."""
        (name,) = self.arguments
        folder = Path(self.env.srcdir) / FOLDER
        path = folder / f"{name}.txt"
        self.env.note_dependency(path)
        try:
            command = read_figures(folder)[name].command
            parts = list(read_output(self._shown(path.read_text(encoding="utf-8"))))
        except (KeyError, OSError, ValueError) as error:
            raise self.severe(f"no table of {name}: {error!r}") from error
        shown = self.env.temp_data.setdefault("colift_results", set())
        found: list[nodes.Node] = [] if name in shown else [_command(command)]
        shown.add(name)
        for place, part in enumerate(parts):
            following = parts[place + 1] if place + 1 < len(parts) else ""
            if isinstance(part, PrintedTable):
                before = parts[place - 1] if place else ""
                found.append(_table(part, before if _is_title(before) else ""))
            elif not (isinstance(following, PrintedTable) and _is_title(part)):
                found.append(nodes.paragraph("", part, classes=["printed"]))
        return found

    def _shown(self, text: str) -> str:
        """Return the part of an output that the options choose."""
        lines = text.splitlines()
        start, end = self.options.get("start-at"), self.options.get("end-before")
        first = self._line(lines, start) if start else 0
        return "\n".join(lines[first : self._line(lines[first:], end) + first if end else None])

    def _line(self, lines: list[str], text: str) -> int:
        place = next((place for place, line in enumerate(lines) if text in line), None)
        if place is None:
            raise self.severe(f"the output of {self.arguments[0]} has no {text!r}")
        return place


def _is_title(part: str | PrintedTable) -> bool:
    """Return whether a part above a table is its title, and no sentence."""
    return isinstance(part, str) and 0 < len(part) <= WIDTH and part[-1] not in ".:"


def _command(text: str) -> nodes.Node:
    """Return the command: within the line, if it is one."""
    if "\n" in text:
        return nodes.literal_block(text, text, language="console")
    parts = nodes.Text("Printed by "), nodes.literal(text, text), nodes.Text(":")
    return nodes.paragraph("", "", *parts, classes=["printed"])


def _table(printed: PrintedTable, title: str) -> nodes.table:
    """Return a table of the page; numbers stand at the right."""
    group = nodes.tgroup(cols=len(printed.head))
    group += [nodes.colspec(colwidth=1) for _ in printed.head]
    sides = ["text-right" if numeric else "text-left" for numeric in printed.numeric]
    for kind, rows in ((nodes.thead, (printed.head,)), (nodes.tbody, printed.rows)):
        part = kind()
        for cells in rows:
            row = nodes.row()
            for text, side in zip(cells, sides, strict=True):
                row += nodes.entry("", nodes.paragraph("", _words(text)), classes=[side])
            part += row
        group += part
    caption = [nodes.title("", title)] if title else []
    return nodes.table("", *caption, group, classes=["printed"])


def _words(text: str) -> str:
    """Return the words of a cell: numbers apart, and a name that folds after its commas."""
    apart = re.sub(" {2,}", " \N{MIDDLE DOT} ", text)
    return re.sub(r"(?<=\w),(?=\w)", ",\N{ZERO WIDTH SPACE}", apart)


def mark(app: Sphinx, doctree: nodes.document) -> None:
    """Mark the outputs within a block whose tables fit the page: lines of a table are indented."""
    for block in doctree.findall(nodes.literal_block):
        lines = block.astext().splitlines()
        if "source" in block and all(len(line) <= WIDTH for line in lines if line[:1] == " "):
            block["classes"].append(FOLDS)


class OneName(SphinxPostTransform):
    """Leaves the name of a table to the table: the theme repeats it around the table."""

    formats = ("html",)
    default_priority = 600  # After the theme's.

    def run(self, **kwargs: Any) -> None:
        """Take the names from the boxes."""
        for box in self.document.findall(nodes.container):
            if "table-wrapper" in box["classes"]:
                box["ids"] = []


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the role and the directive, and mark the outputs of a page that has been read."""
    app.add_role("figure", Figure())
    app.add_directive("result-table", ResultTable)
    app.connect("doctree-read", mark)
    app.add_post_transform(OneName)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
