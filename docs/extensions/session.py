"""Pages that are executed: files are written, commands run, and their output is on the page.

The directives of a page work in one folder of its own, in the order of the page. A command that
fails, or that prints something else than the page expects, fails the build.
"""

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any, ClassVar, Final

from docutils import nodes
from docutils.parsers.rst import directives
from page_session import Session
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

LOADING: Final = 120
"""Longest time that a page may take to be shown [s]: others are built at the same time."""

LANGUAGES: Final = {".py": "python", ".toml": "toml", ".urdf": "xml"}
"""Languages of files by their suffixes."""


class _InSession(SphinxDirective):
    """A directive that works in the folder of its page."""

    has_content = True

    @property
    def session(self) -> Session:
        """The session of the page, which begins with its first directive."""
        found: Session | None = self.env.temp_data.get("colift_session")
        if found is None:
            found = self.env.temp_data["colift_session"] = Session()
        return found

    def block(self, text: str, language: str) -> nodes.literal_block:
        """Return a block of code."""
        block = nodes.literal_block(text, text, language=language)
        self.set_source_info(block)
        return block


class File(_InSession):
    """Write the content to a file of the page's folder, and show it with its name.

    Without content, the file is that of the same name in ``examples/tutorials``.
    """

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Write and show the file."""
        name = self.arguments[0]
        text = "\n".join(self.content) or self._stored(name)
        path = self.session.path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text + "\n", encoding="utf-8")
        language = LANGUAGES.get(path.suffix, "text")
        container = nodes.container("", literal_block=True, classes=["literal-block-wrapper"])
        container += [nodes.caption(name, name), self.block(text, language)]
        return [container]

    def _stored(self, name: str) -> str:
        path = Path(self.env.srcdir).parent / "examples" / "tutorials" / name
        if not path.is_file():
            raise self.severe(f"{name} has no content, and there is no {path}")
        self.env.note_dependency(path)
        return path.read_text(encoding="utf-8").rstrip("\n")


class Run(_InSession):
    """Run each line as a command of a shell, and show it with its output.

    ``:exit:`` is the expected exit code, by default 0; ``:expect:`` a text in the output;
    ``:lines:`` the number of lines that are shown; ``:quiet:`` shows none.
    """

    option_spec: ClassVar[dict[str, Any]] = {
        "exit": int,
        "expect": directives.unchanged_required,
        "lines": directives.positive_int,
        "quiet": directives.flag,
    }

    def run(self) -> list[nodes.Node]:
        """Run the commands, and return one block for all of them."""
        shown = []
        for command in "\n".join(self.content).replace("\\\n", "\\\0").splitlines():
            line = command.replace("\0", "\n")
            try:
                output, code = self.session.run(line)
            except subprocess.TimeoutExpired as error:
                raise self.severe(f"{line!r} did not end within {error.timeout:.0f} s") from error
            if code != self.options.get("exit", 0):
                raise self.severe(f"{line!r} ended with exit code {code}:\n{output}")
            shown += [f"$ {line}", *self._part(output)]
        text = "\n".join(shown)
        expected = self.options.get("expect")
        if expected and expected not in text:
            raise self.severe(f"the output has no {expected!r}:\n{text}")
        return [self.block(text, "console")]

    def _part(self, output: str) -> list[str]:
        """Return the lines of an output that the page shows."""
        lines = [] if "quiet" in self.options else output.splitlines()
        most = self.options.get("lines", len(lines))
        return lines if len(lines) <= most else [*lines[:most], "..."]


class Serve(_InSession):
    """Start a server that runs until the page ends; ``:ready:`` is in the line to wait for."""

    option_spec: ClassVar[dict[str, Any]] = {"ready": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        """Start the server and show its first output."""
        [command] = self.content
        try:
            output = self.session.serve(command, self.options["ready"])
        except RuntimeError as error:
            raise self.severe(str(error)) from error
        return [self.block(f"$ {command}\n{output}", "console")]


class Picture(_InSession):
    """Show a picture of the page's folder; the content is its description."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Copy the picture to where the site takes pictures from, and show it."""
        made = self.session.path / self.arguments[0]
        if not made.is_file():
            raise self.severe(f"no picture {self.arguments[0]} has been made")
        return [self._shown(made)]

    def _shown(self, made: Path) -> nodes.Node:
        """Return the picture as a node."""
        name = f"{self.env.docname.replace('/', '-')}-{made.name}"
        folder = Path(self.env.srcdir) / "generated" / "pictures"
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(made, folder / name)
        image = nodes.image(uri=f"/generated/pictures/{name}", alt=" ".join(self.content))
        self.set_source_info(image)
        return image


class Screenshot(Picture):
    """Show a page of a server in a browser: ``{screenshot} ADDRESS``, with its size in pixels.

    ``:follow:`` is the text of a link on the page that leads to the one that is shown.
    """

    option_spec: ClassVar[dict[str, Any]] = {
        "width": directives.positive_int,
        "height": directives.positive_int,
        "follow": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        """Take the picture and show it."""
        from playwright.sync_api import sync_playwright

        address = self.arguments[0]
        words = f"{address.partition('://')[2]} {self.options.get('follow', '')}"
        name = re.sub(r"\W+", "-", words).strip("-")
        made = self.session.path / f"{name}.png"
        size = {"width": self.options.get("width", 1100), "height": self.options.get("height", 700)}
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"))
            page = browser.new_page(viewport=size)
            page.set_default_timeout(1000 * LOADING)
            response = page.goto(self.session.real(address), wait_until="networkidle")
            if response is None or not response.ok:
                raise self.severe(f"{address} cannot be shown: {response and response.status}")
            if "follow" in self.options:
                page.get_by_role("link", name=self.options["follow"], exact=True).first.click()
                page.wait_for_load_state("networkidle")
            page.screenshot(path=made)
            browser.close()
        return [self._shown(made)]


def _end(app: Sphinx, doctree: nodes.document) -> None:
    """Close the session of the page that has been read."""
    session: Session | None = app.env.temp_data.pop("colift_session", None)
    if session is not None:
        session.close()


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives."""
    app.add_directive("file", File)
    app.add_directive("run", Run)
    app.add_directive("serve", Serve)
    app.add_directive("picture", Picture)
    app.add_directive("screenshot", Screenshot)
    app.connect("doctree-read", _end)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
