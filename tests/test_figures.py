"""The recorded figures: registered, unedited, shown with their commands, and quoted as printed."""

import re
from pathlib import Path

import pytest
from colift.benchmark.figures.making import statuses
from colift.benchmark.figures.records import RECORDS
from colift.benchmark.figures.registry import FOLDER, REGISTRY, read_figures

ROOT = Path(__file__).parents[1]
FIGURES = read_figures(ROOT / FOLDER)
PAGES = [ROOT / "README.md", *sorted(ROOT.glob("docs/**/*.md"))]
QUESTIONS = ROOT / "leaderboard" / "pages" / "templates" / "open.md"

MINUS = "\N{MINUS SIGN}"
INCLUDED = r"^```\{(?:literal)?include\} (?:/|\.\./)figures/(\S+)$"
TABLE = r"^```\{result-table\} (\S+)$"
PICTURE = r"!\[[^\]]*\]\([^)]*figures/([^)]+)\)"
MOVING = r"^(?:```\{moving\}|:still:) /figures/(\S+)$"
EMBEDDED = r"(?:src|srcset)=\"docs/figures/([^\"]+)\""
QUOTED = r"\{figure\}`([^|`]+)\|([^`]+)`"


def words(text):
    """Return a text on one line, as a command is read across the lines of a shell."""
    return " ".join(text.replace("\\\n", " ").split())


def shown(page):
    """Return the names of the files of figures that a page shows with a command of its own."""
    text = page.read_text()
    return [
        name
        for pattern in (INCLUDED, PICTURE, MOVING, EMBEDDED)
        for name in re.findall(pattern, text, re.MULTILINE)
    ]


def tables(page):
    """Return the names of the figures whose tables a page shows; each table has its command."""
    return re.findall(TABLE, page.read_text(), re.MULTILINE)


def printed(name):
    return (ROOT / FOLDER / f"{name}.txt").read_text()


def is_pending(name):
    """Return whether a file only says that the figure has not been made."""
    path = ROOT / FOLDER / f"{name}.txt"
    return path.exists() and path.read_text().startswith("Not measured yet")


def test_every_file_is_registered_and_as_it_was_made():
    files = {name for figure in FIGURES.values() for name in figure.files}
    there = {path.name for path in (ROOT / FOLDER).iterdir()}
    assert there == {REGISTRY, RECORDS} | files
    wrong = ("never made", "missing", "edited")
    assert [
        name
        for name, status in statuses(ROOT).items()
        if " ".join(status.reasons).endswith(wrong) and not is_pending(name)
    ] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_names_the_command_of_each_figure_that_it_shows(page):
    text = words(page.read_text())
    for file in shown(page):
        (figure,) = (each for each in FIGURES.values() if file in each.files)
        remade = f"colift figures --remake {figure.name}"
        named = words(figure.command) in text or remade in text or figure.name in tables(page)
        assert named, f"{page.name} shows {file}"


def test_every_figure_is_shown_or_quoted_somewhere():
    used = {file for page in PAGES for file in shown(page)}
    quoted = {name for page in PAGES for name, _ in re.findall(QUOTED, page.read_text())}
    quoted.update(name for page in PAGES for name in tables(page))
    assert [
        name
        for name, figure in FIGURES.items()
        if name not in quoted and not used.intersection(figure.files)
    ] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_quoted_number_stands_in_the_output(page):
    for name, number in re.findall(QUOTED, page.read_text()):
        assert number in printed(name), f"{page.name}: figures/{name}.txt has no {number}"


def test_the_readme_quotes_the_human_human_baseline_of_the_paper():
    if is_pending("paper"):
        pytest.skip("the paper's report is not recorded yet")
    (number,) = set(re.findall(r"\d\.\d{3}(?= mm)", (ROOT / "README.md").read_text()))
    assert f"paper {number} mm" in printed("paper")


def test_the_open_questions_quote_what_their_commands_print():
    """The page is shown by boards, which have no role for a quoted number."""
    by_command = {
        "colift compare --all": ("compare",),
        "colift references --recordings FILE.csv": ("references-recorded",),
        "colift references": ("references", "references-recorded"),
        "colift ablate": ("ablate",),
        "colift sweep": ("sweep",),
    }
    rows = re.findall(r"^\| \*\*.*\|$", QUESTIONS.read_text(), re.MULTILINE)
    numbers = 0
    for row in rows:
        _, _, known, command, _ = row.split("|")
        names = by_command.get(command.split("`")[1] if "`" in command else "", ())
        if any(map(is_pending, names)):
            continue
        output = "".join(map(printed, names))
        for number in re.findall(rf"[{MINUS}+]?\d+\.\d+", known):
            assert number.replace(MINUS, "-") in output, f"{number} in {row}"
            numbers += 1
    assert numbers > 10
