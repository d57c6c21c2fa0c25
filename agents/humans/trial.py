"""A trial of a file of recordings: the lift, and what was measured beside it."""

import functools
from dataclasses import dataclass

import numpy as np
from colift.agents.humans.recordings import Recording
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class Trial:
    """A recorded lift of one hand, with the other end of the table where it was recorded.

    What is beside the hand changes no lift that is played from it.
    """

    recording: Recording
    """The lift of the hand."""
    far: tuple[float, ...] = ()
    """Height of the other person's end at each time of the recording [m], from the same origin;
    empty if it was not recorded."""
    tilts: tuple[float, ...] = ()
    """Inclination of the table at each time [deg], positive if the hand's end is the higher one;
    empty if it was not recorded."""
    forces: tuple[float, ...] = ()
    """Vertical force at the hand at each time [N], from any zero; empty if it was not recorded."""
    phases: tuple[str, ...] = ()
    """Name of the part of the lift at each time, empty between two; empty if there are none."""

    @functools.cached_property
    def times(self) -> NDArray[np.float64]:
        """Time of each sample [s], shape (n,)."""
        return np.array(self.recording.times)

    @functools.cached_property
    def heights(self) -> NDArray[np.float64]:
        """Height of the hand at each time [m], shape (n,)."""
        return np.array(self.recording.heights)
