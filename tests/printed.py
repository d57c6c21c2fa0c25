"""What must hold for every figure that goes into print, read from its files."""

import io
import re
import xml.etree.ElementTree as ET
from pathlib import Path

from colift.benchmark.paper.topics.timing import BY_LATENCY
from colift.benchmark.rendering import style
from colift.benchmark.rendering.layout import Layout
from PIL import Image
from pypdf import PdfReader

SVG = "{http://www.w3.org/2000/svg}"

PALETTE = {
    *(value.lower() for value in vars(style).values() if re.fullmatch("#[0-9A-F]{6}", str(value))),
    *(colour.lower() for colour, _, _ in style.LOOKS),
    *(colour.lower() for colour, _ in BY_LATENCY),
}
"""Colours that are told apart with any kind of colour vision, and greys."""


def check_figure(path: Path, layout: Layout, *, pictures: int = 0) -> set[str]:
    """Check a figure's SVG and PDF, and return the words in it.

    Parameters
    ----------
    path
        The figure's files, without their suffix.
    layout
        The layout for which it was made.
    pictures
        Number of pictures of pixels that are part of it.
    """
    words = _check_svg(path.with_suffix(".svg"), layout, pictures)
    _check_pdf(path.with_suffix(".pdf"), layout, pictures, words)
    return words


def check_size(path: Path, layout: Layout) -> None:
    """Check that a PNG has 300 pixels per inch of its layout."""
    with Image.open(path.with_suffix(".png")) as picture:
        assert abs(picture.width - 300 * layout.width) <= 1


def assert_neutral(page: str) -> None:
    """Check that a view has no background, and no colour that only light or only dark suits."""
    assert not re.search("background(-color)?: (?!transparent)", page)
    named = re.findall("(?:fill|stroke|color): (#[0-9a-f]+|black|white)", page)
    assert {*named} <= {style.HUMAN.lower(), style.ROBOT.lower()}


def _check_svg(path: Path, layout: Layout, pictures: int) -> set[str]:
    root = ET.fromstring(path.read_bytes())
    width, height = (float(root.attrib[name].removesuffix("pt")) for name in ("width", "height"))
    assert abs(width - 72 * layout.width) < 1
    assert layout.height is None or abs(height - 72 * layout.height) < 1
    assert len(list(root.iter(f"{SVG}image"))) == pictures
    texts = list(root.iter(f"{SVG}text"))
    for each in texts:
        size = re.search(r"font-size: ([\d.]+)px; font-family: 'DejaVu Sans'", each.attrib["style"])
        assert size is not None
        assert float(size[1]) >= layout.letters
    source = path.read_text()
    assert {colour.lower() for colour in re.findall("#[0-9a-fA-F]{6}", source)} <= PALETTE
    assert not re.search(
        r"<dc:date>|matplotlib v|https?://(?!www\.w3\.org|purl\.org|creativecommons)", source
    )
    words = {word for each in texts for word in "".join(each.itertext()).split()}
    assert words
    return words


def _check_pdf(path: Path, layout: Layout, pictures: int, words: set[str]) -> None:
    reader = PdfReader(io.BytesIO(path.read_bytes()))
    (page,) = reader.pages
    assert abs(float(page.mediabox.width) - 72 * layout.width) < 1
    assert set(reader.metadata or {}) == {"/Title"}
    assert len(page.images) == pictures
    for font in page["/Resources"]["/Font"].values():
        assert font["/Subtype"] == "/Type0"
        (inner,) = font["/DescendantFonts"]
        assert inner.get_object()["/Subtype"] == "/CIDFontType2"
        assert "DejaVuSans" in inner.get_object()["/BaseFont"]
        assert "/FontFile2" in inner.get_object()["/FontDescriptor"]
    # Words that stand close to each other are read as one.
    text = "".join(page.extract_text().split())
    assert [word for word in words if word not in text] == []
