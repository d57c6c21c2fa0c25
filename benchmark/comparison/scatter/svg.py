"""The scatter picture as SVG for pages, whose style sheets define the colours, light and dark."""

from collections.abc import Sequence

from colift.benchmark.comparison.scatter.drawing import Anchor, Colour, draw
from colift.benchmark.comparison.scatter.scale import Box, Place
from colift.benchmark.comparison.scatter.scene import RADIUS, Dot, ScatterScene
from markupsafe import Markup, escape


def svg(scene: ScatterScene, kind: str) -> Markup:
    """Return the picture as an element of a page.

    Parameters
    ----------
    scene
        The picture.
    kind
        Its class, such as ``wide`` or ``narrow``: style sheets show one of them.
    """
    pen = _SvgPen()
    draw(scene, pen)
    width, height = scene.size
    return Markup(
        f'<svg class="picture {escape(kind)}" viewBox="0 0 {width} {height}" role="img" '
        f'aria-label="{escape(scene.summary)}">\n' + "\n".join(pen.elements) + "\n</svg>"
    )


class _SvgPen:
    """Draws elements of SVG; a colour is a variable of the page's style sheet."""

    def __init__(self) -> None:
        self.elements: list[str] = []

    def rectangle(self, box: Box, colour: Colour) -> None:
        left, top, right, bottom = box
        self.elements.append(
            f'<path d="M{left:.1f} {top:.1f}H{right:.1f}V{bottom:.1f}H{left:.1f}z" '
            f'fill="var(--{colour})"/>'
        )

    def line(
        self,
        places: Sequence[Place],
        colour: Colour,
        width: float,
        *,
        opacity: float = 1.0,
        dashed: bool = False,
    ) -> None:
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        dashes = ' stroke-dasharray="4 3"' if dashed else ""
        self.elements.append(
            f'<polyline points="{points}" fill="none" stroke="var(--{colour})" '
            f'stroke-width="{width}" opacity="{opacity}"{dashes}/>'
        )

    def text(
        self,
        at: Place,
        text: str,
        colour: Colour,
        size: float,
        *,
        anchor: Anchor = "middle",
        bold: bool = False,
        italic: bool = False,
        upward: bool = False,
        halo: bool = False,
    ) -> None:
        x, y = at
        place = f'x="{x:.1f}" y="{y:.1f}"'
        if upward:
            place = f'transform="translate({x:.1f} {y:.1f}) rotate(-90)"'
        self.elements.append(
            f'<text {place} fill="var(--{colour})" font-size="{size}" text-anchor="{anchor}"'
            + ' font-weight="650"' * bold
            + ' font-style="italic"' * italic
            + ' stroke="var(--paper)" stroke-width="3" stroke-linejoin="round" '
            'paint-order="stroke"' * halo + f">{escape(text)}</text>"
        )

    def marker(self, dot: Dot, colour: Colour, *, filled: bool) -> None:
        (x, y), r = dot.at, RADIUS
        shape = {
            "policy": f"M{x - r:.1f} {y:.1f}a{r} {r} 0 1 1 {2 * r} 0a{r} {r} 0 1 1 -{2 * r} 0z",
            "baseline": f"M{x:.1f} {y - 6.5:.1f}l6.5 6.5-6.5 6.5-6.5-6.5z",
            "reference": f"M{x - 4.5:.1f} {y - 4.5:.1f}h9v9h-9z",
        }[dot.point.kind]
        self.elements.append(
            f'<path class="{dot.point.kind}{" best" * dot.best}" d="{shape}" '
            f'fill="var(--{colour if filled else "paper"})" stroke="var(--{colour})" '
            f'stroke-width="1.7"><title>{escape(dot.tip)}</title></path>'
        )
