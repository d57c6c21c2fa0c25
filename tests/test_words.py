"""Wording: habits to avoid in code, messages and pages, each with the better words."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Final

import pytest

pytestmark = pytest.mark.smoke

ROOT: Final = Path(__file__).parents[1]
FOLDERS: Final = ("agents", "benchmark", "cli", "docs", "examples", "leaderboard", "robots")
PAGES: Final = (".css", ".html", ".js", ".md", ".xml")

NOUNS: Final = (
    "behaviour|call|class|column|command|day|entry|field|file|folder|frame|function|hash|job|lift|"
    "line|message|minute|number|page|policy|process|row|sample|season|second|step|subject|thread|value"
)
"""Nouns that are counted."""

WORDS: Final[Mapping[str, str]] = {
    r"who(ever)? keeps (the|a) board": "the maintainer",
    r"whose an? \w+ is": "the owner of",
    r"what came of": "the outcome of",
    r"what there is": "the names of what is there",
    r"whom to (tell|ask)": "the noun",
    r"(is|are|was|were|be|been) told (of|that|how|what|who|why|where|whether)": "reported",
    r"tells? nothing": "carries no information",
    rf"(one|two) ({NOUNS}) an? ({NOUNS})": "per: one row per lift",
    r"mend(s|ed|ing)?": "fix, correct",
    r"rungs?|ladder": "isolation level",
    r"fig\. leaf": "the fact itself",
    r"as ever": "as usual",
    r"for ever": "forever, or the limit",
    r"has not its": "lacks its",
    r"that is what": "a plain statement",
}
"""Patterns in comments, strings and pages, each with the better words; a space is any gap."""

NAMES: Final[Mapping[str, str]] = {
    r"rungs?": "level",
    r"ladder": "levels",
}
"""The same for one word of a Python name, such as ``rung`` in ``next_rung``."""

OPENINGS: Final = r"(What|How|Where|Whom?|Whose|Whether|Why|When|Which|From) "
"""First words of a module's docstring that make it a clause; it should be a noun phrase."""


def sources() -> list[Path]:
    """Return everything that is read by people: code, pages and documentation."""
    found = list(ROOT.glob("*.md"))
    for folder in (*FOLDERS, "src/colift"):
        paths = (ROOT / folder).glob("*" if folder == "src/colift" else "**/*")
        found += [path for path in paths if path.suffix in (".py", *PAGES)]
    return sorted(path for path in found if "data" not in path.relative_to(ROOT).parts)


def pieces(path: Path, text: str) -> Iterator[tuple[int, str, Mapping[str, str]]]:
    """Yield comments, strings and names of Python code, or a page: line, text, its patterns."""
    if path.suffix != ".py":
        yield 1, text, WORDS
        return
    inside = 0  # Of how many f-strings; from Python 3.12 on their parts are tokens.
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        kind = tokenize.tok_name[token.type]
        inside += (kind == "FSTRING_START") - (kind == "FSTRING_END")
        if token.type == tokenize.COMMENT or kind == "FSTRING_MIDDLE":
            yield token.start[0], token.string, WORDS
        elif inside:
            continue
        elif token.type == tokenize.STRING:
            prefix = token.string[:3].lower().partition(token.string[-1])[0]
            shown = re.sub(r"\{[^{}]*\}", "{}", token.string) if "f" in prefix else token.string
            yield token.start[0], shown, WORDS
        elif token.type == tokenize.NAME:
            yield token.start[0], token.string.replace("_", " "), NAMES


def spaced(pattern: str) -> str:
    """Return a pattern of whole words, on one line or several, of code or of a comment."""
    return rf"\b(?:{pattern})\b".replace(" ", r"\s+(?:#\s+)?")


def complaints(path: Path, text: str) -> list[str]:
    """Return a line for every habit to avoid: place, words, and better words."""
    place = path.relative_to(ROOT) if path.is_absolute() else path
    found = []
    for first, piece, patterns in pieces(path, text):
        if not ANY.search(piece):
            continue
        for pattern, better in patterns.items():
            for match in re.finditer(spaced(pattern), piece, re.IGNORECASE):
                line = first + piece.count("\n", 0, match.start())
                found.append(f"{place}:{line}: {' '.join(match[0].split())!r}: write {better}")
    if path.suffix == ".py" and re.match(OPENINGS, ast.get_docstring(ast.parse(text)) or ""):
        found.append(f"{place}:1: the docstring of a module is a noun phrase, not a clause")
    return found


ANY: Final = re.compile("|".join(map(spaced, [*WORDS, *NAMES])), re.IGNORECASE)
"""Any of the patterns, since most pieces have none."""


@pytest.mark.parametrize("folder", [*FOLDERS, "src", ""])
def test_no_habit_to_avoid(folder):
    chosen = [
        path
        for path in sources()
        if (path.relative_to(ROOT).parts[0] if path.parent != ROOT else "") == folder
    ]
    assert chosen
    found = [line for path in chosen for line in complaints(path, path.read_text())]
    assert found == [], "\n" + "\n".join(found)


@pytest.mark.parametrize(
    ("name", "text", "wanted"),
    [
        (
            "a.py",
            '"""Rows.\n\nGiven to who\nkeeps the board.\n"""\n',
            "a.py:3: 'who keeps the board'",
        ),
        ("a.py", "x = 1  # the next rung\n", "a.py:1: 'rung'"),
        ("a.py", "def f():\n    raise ValueError(f'{x}: no ladder')\n", "a.py:2: 'ladder'"),
        ("a.py", "def next_rung():\n    pass\n", "a.py:1: 'rung'"),
        ("a.py", '"""What a row is."""\n', "a.py:1: the docstring of a module"),
        ("a.md", "A board.\n\nWho keeps the board decides.\n", "a.md:3: 'Who keeps the board'"),
    ],
)
def test_each_kind_of_place_is_read(name, text, wanted):
    (line,) = complaints(Path(name), text)
    assert line.startswith(wanted)


def test_values_in_messages_and_other_words_are_left_alone():
    text = 'x = f"{rung} of {ladder!r}: impulse, keeps the table level"  # sprung\n'
    assert complaints(Path("a.py"), text) == []
