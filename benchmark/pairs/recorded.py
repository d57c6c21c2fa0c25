"""The pairs in a file of recordings."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from colift.agents.humans import Trial, load_trials
from colift.agents.humans.beside import LENGTHS, contradiction
from colift.agents.humans.recording_file import other_columns
from colift.agents.humans.recordings import FAR, TILT
from colift.base.errors import InputError
from colift.benchmark.pairs.coordination import Ends


@dataclass(frozen=True, kw_only=True, eq=False)
class PairLift:
    """A recorded lift of a pair."""

    trial: Trial
    ends: Ends

    @property
    def name(self) -> str:
        """The trial."""
        return self.trial.recording.name

    @property
    def pair(self) -> str:
        """Name of the pair, by the column ``person``; empty if the file names none."""
        return self.trial.recording.person


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedPairs:
    """The lifts of a file that have a far end."""

    lifts: tuple[PairLift, ...]
    without: tuple[str, ...]
    """The trials that have none."""


def recorded_pairs(path: Path, length: float | None = None) -> RecordedPairs:
    """Return the pairs in a file of recordings.

    Parameters
    ----------
    path
        The file.
    length
        Distance between the ends of the table [m]; trials with an inclination but without heights
        of the far end need it.

    Raises
    ------
    InputError
        If the file cannot be used, no trial has a far end, or the length is missing, out of range,
        or not that of a trial's heights and inclinations.
    """
    if length is not None and not LENGTHS[0] <= length <= LENGTHS[1]:
        raise InputError(
            f"the table's length is {length:g} m, must be from {LENGTHS[0]:g} to {LENGTHS[1]:g} m"
        )
    trials = load_trials(path)
    if not any(trial.far or trial.tilts for trial in trials):
        others = ", ".join(map(repr, other_columns(path)))
        raise InputError(
            f"{path}: no trial has the other end of the table: needs the column {FAR}, the height "
            f"of the other person's end [m], or {TILT}, the table's inclination [deg]"
            + (f" (rename one of {others:.200}?)" if others else "")
        )
    for trial in trials:
        if not trial.far and trial.tilts and length is None:
            raise InputError(
                f"{path}: trial {trial.recording.name!r:.80} has {TILT} but no {FAR}: its height "
                "differences follow from the distance between the table's ends: --length METRES"
            )
        if trial.far and trial.tilts and length is not None:
            differences = trial.heights - np.array(trial.far)
            tilts = np.array(trial.tilts)
            for fault in contradiction(trial.times, differences, tilts, (length, length)):
                raise InputError(
                    f"{path}: trial {trial.recording.name!r:.80} is of no table of --length "
                    f"{length:g}: {fault.text}"
                )
    names = [trial.recording.name for trial in trials if not (trial.far or trial.tilts)]
    return RecordedPairs(lifts=pair_lifts(trials, length), without=tuple(names))


def pair_lifts(trials: Sequence[Trial], length: float | None = None) -> tuple[PairLift, ...]:
    """Return the trials whose far end is known, with both ends; the length is that of the table."""
    both = ((trial, ends_of(trial, length)) for trial in trials)
    return tuple(PairLift(trial=trial, ends=ends) for trial, ends in both if ends is not None)


def ends_of(trial: Trial, length: float | None = None) -> Ends | None:
    """Return the two ends of a trial; None if the far one is not known."""
    tilts = np.array(trial.tilts) if trial.tilts else None
    if trial.far:
        far = np.array(trial.far)
    elif tilts is not None and length is not None:
        far = trial.heights - length * np.sin(np.radians(tilts))
    else:
        return None
    return Ends(
        times=trial.times,
        near=trial.heights,
        far=far,
        tilts=tilts,
        length=length,
        force=np.array(trial.forces) if trial.forces else None,
        phases=trial.phases,
    )
