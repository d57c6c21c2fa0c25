"""Pages that need nothing else: style, pictures and tables are in the one file."""

import re
from collections.abc import Sequence
from html import escape
from typing import Final

STYLE: Final = """
:root { color-scheme: light dark; --ink: #22262e; --faint: #5b6472; --line: #d7dbe0;
  --paper: #ffffff; --card: #f2f4f7; --sky: #eff2f6; --human: #0072b2; --robot: #c25100; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e7ec; --faint: #a2abb8; --line: #3a414d; --paper: #15181d; --card: #20262e;
    --sky: #1d222a; --human: #56b4e9; --robot: #ff9a5c; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 66rem; margin: 0 auto; padding: 2.5rem 1.25rem 5rem; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 1rem; text-wrap: balance; }
h2 { font-size: 1.3rem; margin: 3rem 0 0.75rem; padding-top: 1rem;
  border-top: 1px solid var(--line); }
p, li { max-width: 46rem; }
p { margin: 0.6rem 0; }
.faint, figcaption { color: var(--faint); font-size: 0.9rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 0.9rem;
  margin: 1rem 0; white-space: nowrap; }
th, td { padding: 0.35rem 0.65rem; text-align: right; border-bottom: 1px solid var(--line);
  vertical-align: top; }
thead th { font-weight: 600; color: var(--faint); vertical-align: bottom; }
tbody th { font-weight: 500; text-align: left; position: sticky; left: 0;
  background: var(--paper); white-space: normal; overflow-wrap: break-word; min-width: 8rem; }
thead th:first-child { text-align: left; }
td small { display: block; font-size: 0.8rem; color: var(--faint); }
td.best { background: var(--card); }
td.best b { color: var(--robot); }
tr.reference th, tr.reference td { color: var(--human); }
figure { margin: 1.5rem 0 2rem; }
figure svg { display: block; width: 100%; height: auto; }
figure svg text { font-family: inherit !important; }
figure svg.wide { max-width: 56rem; }
figure svg.narrow { display: none; }
@media (max-width: 40rem) {
  main { padding: 1.5rem 1rem 4rem; }
  figure svg.wide { display: none; }
  figure svg.narrow { display: block; } }
"""


def page(title: str, body: str, *, style: str = "") -> str:
    """Return an HTML page that requests nothing from elsewhere.

    Parameters
    ----------
    title
        Title as plain text.
    body
        Content as HTML.
    style
        CSS that only this page needs.
    """
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{STYLE}{style}</style></head>\n"
        f"<body><main>\n{body}\n</main></body></html>\n"
    )


def table(header: Sequence[str], rows: Sequence[str]) -> str:
    """Return a table that scrolls where the page is narrow.

    Parameters
    ----------
    header
        Columns' titles as plain text.
    rows
        Rows as HTML, each of :func:`row`.
    """
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    body = "\n".join(rows)
    return (
        f'<div class="scroll"><table><thead><tr>{head}</tr></thead>\n'
        f"<tbody>{body}</tbody></table></div>"
    )


def row(name: str, cells: Sequence[str], *, kind: str = "") -> str:
    """Return a row: its name as plain text, its cells as HTML, each of :func:`cell`.

    ``kind`` is its class, such as ``reference``.
    """
    marked = f' class="{kind}"' if kind else ""
    breakable = re.sub("([,_])", r"\1<wbr>", escape(name))
    return f"<tr{marked}><th>{breakable}</th>{''.join(cells)}</tr>"


def cell(value: str, under: str = "", *, best: bool = False) -> str:
    """Return a cell: its value, and what is written small under it, as plain text."""
    told = f"<b>{escape(value)}</b>" if best else escape(value)
    small = f"<small>{escape(under)}</small>" if under else ""
    return f"<td{' class=best' if best else ''}>{told}{small}</td>"
