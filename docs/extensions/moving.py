"""The directive ``moving``: an animation, and a still in its place where motion is not wanted.

```{moving} /figures/idea.webp
:still: /figures/idea.png
Its description.
```

The animation plays once, in at most five seconds (WCAG 2.2.2); a click plays it again.
"""

import html
import posixpath
from pathlib import Path
from typing import Any, ClassVar
from urllib.parse import quote

from docutils import nodes
from docutils.parsers.rst import directives
from PIL import Image
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective


class moving(nodes.General, nodes.Element):  # noqa: N801
    """A still and an animation, two images."""


class Moving(SphinxDirective):
    """An animation with a still."""

    required_arguments = 1
    has_content = True
    option_spec: ClassVar[dict[str, Any]] = {"still": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        """Return both images; the site takes their files."""
        words = " ".join(self.content)
        if not words or "still" not in self.options:
            raise self.severe(f"{self.arguments[0]} needs a description and a :still:")
        node = moving("", *(nodes.image(uri=self._found(uri), alt=words) for uri in self._uris()))
        with Image.open(self._path(self.arguments[0])) as film:
            node["width"], node["height"] = film.size
        self.set_source_info(node)
        return [node]

    def _uris(self) -> tuple[str, str]:
        return self.options["still"], self.arguments[0]

    def _path(self, uri: str) -> Path:
        return Path(self.env.relfn2path(uri)[1])

    def _found(self, uri: str) -> str:
        if not self._path(uri).is_file():
            raise self.severe(f"there is no picture {uri}")
        return uri


def visit(writer: Any, node: moving) -> None:
    """Write the picture."""
    still, film = (
        posixpath.join(writer.builder.imgpath, quote(writer.builder.images[image["uri"]]))
        for image in node.findall(nodes.image)
    )
    alt = html.escape(next(node.findall(nodes.image))["alt"])
    writer.body.append(
        f'<a class="moving" href="{film}" title="Play it again"><picture>'
        f'<source media="(prefers-reduced-motion: reduce)" srcset="{still}">'
        f'<img src="{film}" alt="{alt}" width="{node["width"]}" height="{node["height"]}">'
        "</picture></a>\n"
    )
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_node(moving, html=(visit, None))
    app.add_directive("moving", Moving)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
