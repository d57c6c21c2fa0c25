"""Execution of an intention by a hand: noise, tremor, slow visual correction."""

import math
from collections.abc import Sequence
from typing import Any, Final, Generic, NamedTuple

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans.subject import Subject
from colift.agents.rules import SCALARS, ArrayFunctions, N, View
from colift.robots.arithmetic import dot, each
from numpy.typing import NDArray

NOISE_CORRELATION: Final = 0.1
"""Time [s] in which the autocorrelation of the motor noise falls to 1/e."""

LEAK: Final = 0.7
"""Time constant with which a position error from motor noise is forgotten [s]."""

CORRECTION_GAIN: Final = 1.0
"""Integral gain of the voluntary correction [1/s]."""

CORRECTION_LIMIT: Final = 0.03
"""Largest voluntary correction [m]."""

BLOCK: Final = 250
"""Frames of noise drawn at a time."""

_KEPT: Final = math.exp(-FRAME / LEAK)

# A Gaussian kernel of width s gives noise with the autocorrelation exp(-t^2 / (4 s^2)).
_WIDTH: Final = 0.5 * NOISE_CORRELATION / FRAME
_BELL: Final = each(math.exp, -0.5 * (np.arange(-3 * _WIDTH, 3 * _WIDTH + 1) / _WIDTH) ** 2)
KERNEL: Final = _BELL / math.sqrt(dot(_BELL, _BELL))


class HandMemory(NamedTuple, Generic[N]):
    """What a hand keeps from step to step; all 0 at the beginning."""

    error: N
    """Error of its position by motor noise [m]."""
    correction: N
    """The voluntary correction [m]."""
    target: N
    """The intended height in the last frame [m]."""


class HandNoise(NamedTuple):
    """The noise of a hand in some frames: a list of numbers, or an array (f, n)."""

    gain: Any
    """Motor noise relative to the velocity."""
    tremor: Any
    """Tremor [m]."""


def corrected(f: ArrayFunctions[N], correction: N, missing: N, frames: int) -> N:
    """Return the voluntary correction after a step of ``frames`` frames [m].

    It integrates the height error ``missing`` as seen one visual delay ago [m], and is limited.
    """
    wanted = correction + CORRECTION_GAIN * missing * frames * FRAME
    return f.clip(wanted, -CORRECTION_LIMIT, CORRECTION_LIMIT)


def move_hand(
    f: ArrayFunctions[N],
    memory: HandMemory[N],
    missing: N,
    target: Sequence[N],
    noise: HandNoise,
) -> tuple[HandMemory[N], Sequence[N]]:
    """Return the memory after a step, and the hand's reference height in each of its frames [m].

    The reference in frame i is ``target_i + e_i + tremor_i + c_i`` with

    * signal-dependent noise ``e_i = exp(-FRAME / LEAK) e_(i-1) + k g_i (target_i - target_(i-1))``,
      k the subject's motor noise and g smooth noise of unit variance: the error of the velocity is
      proportional to it, and that of the position decays (Harris and Wolpert 1998);
    * the subject's tremor, a sine of random phase;
    * a voluntary correction c (:func:`corrected`): the hand arrives even when the robot only holds.
      Over the step it changes at a constant rate.
    """
    correction = corrected(f, memory.correction, missing, len(target))
    change = (correction - memory.correction) / len(target)

    def frame(held: tuple[N, N, N], due: tuple[Any, ...]) -> tuple[tuple[N, N, N], N]:
        (error, current, before), (height, gain, tremor) = held, due
        error = _KEPT * error + gain * (height - before)
        current = current + change
        return (error, current, height), height + error + tremor + current

    held = memory.error, memory.correction, memory.target
    (error, _, last), references = f.frames(frame, held, (target, noise.gain, noise.tremor))
    return HandMemory(error, correction, last), references


def carry_out(
    f: ArrayFunctions[N],
    memory: HandMemory[N],
    view: View[N],
    target: Sequence[N],
    noise: HandNoise,
) -> tuple[HandMemory[N], Sequence[N]]:
    """Return the memory after a step and the references of :func:`move_hand`, as the person sees.

    The height error is that of the person's end from its intended height one visual delay ago.
    """
    late = view.visual
    missing = view.seen("target", late) - view.seen("human_end", late)
    return move_hand(f, memory, missing, target, noise)


class NoiseStream:
    """The noise of one hand, drawn block by block: it depends on the seed and the frame alone."""

    def __init__(self, subject: Subject, seed: int) -> None:
        self._subject = subject
        self._rng = np.random.default_rng(seed)
        self._phase = 2.0 * np.pi * float(self._rng.random())
        self._white = self._rng.standard_normal(len(KERNEL) - 1)
        self._gain: list[float] = []
        self._tremor: list[float] = []

    def between(self, start: int, stop: int) -> HandNoise:
        """Return the noise of the frames ``start`` to ``stop - 1``."""
        while len(self._gain) < stop:
            self._draw()
        return HandNoise(self._gain[start:stop], self._tremor[start:stop])

    def _draw(self) -> None:
        """Draw the noise of the next ``BLOCK`` frames."""
        white = np.concatenate((self._white, self._rng.standard_normal(BLOCK)))
        self._white = white[BLOCK:]
        smooth = dot(np.lib.stride_tricks.sliding_window_view(white, len(KERNEL)), KERNEL)
        first = len(self._tremor)
        omega = 2.0 * np.pi * self._subject.tremor_frequency
        time = FRAME * np.arange(first, first + BLOCK)
        tremor = self._subject.tremor_amplitude * each(math.sin, omega * time + self._phase)
        self._gain += (self._subject.motor_noise * smooth).tolist()
        self._tremor += tremor.tolist()


def drawn_noise(subject: Subject, seed: int, frames: int) -> NDArray[np.float64]:
    """Return gain and tremor (2, frames) of a hand."""
    return np.array(NoiseStream(subject, seed).between(0, frames))


def performed(subject: Subject, target: NDArray[np.float64], seed: int) -> NDArray[np.float64]:
    """Return the heights that a hand pulls towards while the table stays level (n,) [m].

    Parameters
    ----------
    subject
        The person, with tremor and motor noise.
    target
        (n,) intended height in each frame [m].
    seed
        Seed of the noise.
    """
    noise = NoiseStream(subject, seed).between(0, len(target))
    _, heights = move_hand(SCALARS, HandMemory(0.0, 0.0, 0.0), 0.0, target.tolist(), noise)
    return np.array(heights)
