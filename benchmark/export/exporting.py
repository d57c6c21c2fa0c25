"""One export from the lifts to the finished folder."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.base.errors import InputError
from colift.benchmark.export.card import CARD, card
from colift.benchmark.export.contents import Contents
from colift.benchmark.export.croissant import CROISSANT, croissant
from colift.benchmark.export.folder import new_folder
from colift.benchmark.export.lerobot_writer import frame_rate, write_lerobot
from colift.benchmark.export.library import import_minari, import_pyarrow
from colift.benchmark.export.lifts import ExportedLift, Spaces
from colift.benchmark.export.minari_writer import write_minari
from colift.benchmark.export.provenance import STAMP, VIEWS, Provenance

FORMATS: Final = ("minari", "lerobot")


@dataclass(frozen=True, kw_only=True)
class CardWords:
    """The sentences of a data card; see :func:`.card`."""

    about: str
    people: str
    shows: Sequence[str]
    licence: str


def check_format(form: str, view: str) -> None:
    """Refuse an unknown format or view, or one whose library is missing, before any work.

    Raises
    ------
    InputError
        If the format or view is unknown, or its library is missing; the message lists the known
        ones, or has the command that installs the library.
    """
    if form not in FORMATS:
        raise InputError(f"--to must be {' or '.join(FORMATS)}, got {form!r:.80}")
    if view not in VIEWS:
        raise InputError(f"--view must be {' or '.join(VIEWS)}, got {view!r:.80}")
    if form == "minari":
        import_minari()
    else:
        import_pyarrow("parquet")


def export(
    folder: Path,
    lifts: Iterable[ExportedLift],
    spaces: Spaces,
    provenance: Provenance,
    words: CardWords,
    *,
    form: str,
    replace: bool = False,
) -> Contents:
    """Write a data set with its card and its Croissant metadata: all of it, or nothing.

    Parameters
    ----------
    folder
        The new folder.
    lifts
        The lifts; an error in their making leaves no folder.
    spaces
        The agents' spaces.
    provenance
        Their origin.
    words
        The sentences of the card.
    form
        One of :data:`FORMATS`.
    replace
        Whether an older export may be replaced.

    Returns
    -------
    Contents
        The size of the set.

    Raises
    ------
    InputError
        As :func:`.check_new` and :func:`check_format`, or if there is no lift with a step.
    """
    check_format(form, provenance.view)
    if form == "lerobot":
        frame_rate(provenance)
    contents = Contents()
    with new_folder(folder, replace=replace) as made:
        counted = contents.counted(lifts)
        if form == "minari":
            write_minari(made, counted, spaces, provenance)
        else:
            write_lerobot(made, counted, provenance)
        if not contents.lifts:
            raise InputError("there is no lift with a step to export")
        text = card(
            provenance,
            contents,
            form,
            about=words.about,
            people=words.people,
            shows=words.shows,
            licence=words.licence,
        )
        (made / CARD).write_text(text)
        (made / STAMP).write_text(provenance.text())
        described = croissant(
            made,
            provenance,
            about=words.about,
            people=words.people,
            shows=words.shows,
            licence=words.licence,
        )
        (made / CROISSANT).write_text(described, encoding="utf-8")
    return contents
