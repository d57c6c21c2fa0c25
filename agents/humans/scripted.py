"""The human that carries a plan out: with motor noise, tremor, and a slow eye on the result."""

from collections import deque
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..agent import FRAME, HISTORY, Action, HumanObservation, Observation
from .subject import Subject

NOISE_CORRELATION: Final = 0.1
"""Time [s] in which the autocorrelation of the motor noise falls to 1/e."""

LEAK: Final = 0.7
"""Time constant with which a position error from motor noise is forgotten [s]."""

CORRECTION_GAIN: Final = 1.0
"""Integral gain of the voluntary correction [1/s]."""

CORRECTION_LIMIT: Final = 0.03
"""Largest voluntary correction [m]."""

BLOCK: Final = 1000
"""Frames of noise drawn at a time."""

# A Gaussian kernel of width s gives noise with the autocorrelation exp(-t^2 / (4 s^2)).
_WIDTH: Final = 0.5 * NOISE_CORRELATION / FRAME
_BELL: Final = np.exp(-0.5 * (np.arange(-3 * _WIDTH, 3 * _WIDTH + 1) / _WIDTH) ** 2)
_KERNEL: Final = _BELL / np.linalg.norm(_BELL)


class ScriptedHuman:
    """Carries out the private target of the observation as the subject would.

    The hand's reference in frame i is ``target_i + e_i + tremor_i + c_i`` with

    * signal-dependent noise ``e_i = exp(-FRAME / LEAK) e_(i-1) + k g_i (target_i - target_(i-1))``,
      k the subject's motor noise and g smooth noise of unit variance: the velocity is off by a
      share, the position finds back (Harris and Wolpert 1998);
    * the subject's tremor, a sine of random phase;
    * a voluntary correction c, which integrates the height that was seen to be missing one visual
      delay ago and is limited: the hand arrives even when the robot only holds.

    The noise is drawn per frame and depends on the seed and the target alone, so that it is the
    same whatever the robot does.
    """

    def __init__(self, *, subject: Subject) -> None:
        self.subject = subject

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._rng = np.random.default_rng(seed)
        self._phase = 2.0 * np.pi * float(self._rng.random())
        self._white = self._rng.standard_normal(len(_KERNEL) - 1)
        self._gain = np.empty(0)
        self._tremor = np.empty(0)
        self._frame = 0
        self._error = 0.0
        self._correction = 0.0
        self._target = 0.0
        self._past_target = 0.0
        self._missing: deque[float] = deque()
        self._draw_block()

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        target = observation[HumanObservation.TARGET]
        n = len(target)
        start, stop = self._frame, self._frame + n
        while len(self._gain) < stop:
            self._draw_block()

        steps, age = divmod(round(self.subject.visual_delay / FRAME), n)
        age = min(age, HISTORY - 1)
        self._missing.append(self._past_target - float(observation[HISTORY - 1 - age]))
        seen = self._missing.popleft() if len(self._missing) > steps else 0.0
        wanted = self._correction + CORRECTION_GAIN * seen * n * FRAME
        correction = min(max(wanted, -CORRECTION_LIMIT), CORRECTION_LIMIT)

        terms = np.empty(n + 3)
        terms[0] = self._correction
        terms[1] = correction - self._correction
        terms[2] = self._error
        terms[3] = target[0] - self._target
        np.subtract(target[1:], target[:-1], out=terms[4:])
        terms[3:] *= self._gain[start:stop]
        offset = terms @ _response(n)

        self._frame = stop
        self._correction = correction
        self._error = float(offset[-1]) - correction
        self._target = float(target[-1])
        self._past_target = float(target[-1 - age])
        offset += target
        offset += self._tremor[start:stop]
        return offset

    def _draw_block(self) -> None:
        """Draw the noise of the next ``BLOCK`` frames."""
        white = np.concatenate((self._white, self._rng.standard_normal(BLOCK)))
        self._white = white[BLOCK:]
        gain = self.subject.motor_noise * np.convolve(white, _KERNEL, mode="valid")
        first = len(self._tremor)
        omega = 2.0 * np.pi * self.subject.tremor_frequency
        time = FRAME * np.arange(first, first + BLOCK)
        tremor = self.subject.tremor_amplitude * np.sin(omega * time + self._phase)
        self._gain = np.concatenate((self._gain, gain))
        self._tremor = np.concatenate((self._tremor, tremor))


@lru_cache(maxsize=8)
def _response(frames: int) -> NDArray[np.float64]:
    """Return the offset in each frame (columns) per unit of each term of a step (rows).

    Rows: the correction so far, its change (a ramp over the step), the position error so far, and
    the new position error of each frame; the errors leak.
    """
    frame = np.arange(1, frames + 1)
    decay = np.exp(-FRAME / LEAK)
    age = frame - frame[:, np.newaxis]
    errors = np.where(age >= 0, decay ** np.maximum(age, 0), 0.0)
    return np.vstack((np.ones(frames), frame / frames, decay**frame, errors))
