"""The human that carries out a plan, with motor noise, tremor and slow visual correction."""

import math
from collections import deque
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, HISTORY, Action, HumanObservation, Observation
from colift.agents.humans.subject import Subject
from colift.robots.arithmetic import dot, each

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

# A Gaussian kernel of width s gives noise with the autocorrelation exp(-t^2 / (4 s^2)).
_WIDTH: Final = 0.5 * NOISE_CORRELATION / FRAME
_BELL: Final = each(math.exp, -0.5 * (np.arange(-3 * _WIDTH, 3 * _WIDTH + 1) / _WIDTH) ** 2)
_KERNEL: Final = _BELL / math.sqrt(dot(_BELL, _BELL))


class ScriptedHuman:
    """Carries out the private target of the observation as the subject would.

    The hand's reference in frame i is ``target_i + e_i + tremor_i + c_i`` with

    * signal-dependent noise ``e_i = exp(-FRAME / LEAK) e_(i-1) + k g_i (target_i - target_(i-1))``,
      k the subject's motor noise and g smooth noise of unit variance: the error of the velocity is
      proportional to it, and that of the position decays (Harris and Wolpert 1998);
    * the subject's tremor, a sine of random phase;
    * a voluntary correction c, which integrates the height error seen one visual delay ago and is
      limited: the hand arrives even when the robot only holds.

    The noise is drawn per frame and depends on the seed and the target alone, so that it is the
    same whatever the robot does.
    """

    def __init__(self, *, subject: Subject) -> None:
        self.subject = subject
        self._kept = math.exp(-FRAME / LEAK)

    def reset(self, seed: int) -> None:
        """Begin an episode; the noise comes from ``seed``."""
        self._rng = np.random.default_rng(seed)
        self._phase = 2.0 * np.pi * float(self._rng.random())
        self._white = self._rng.standard_normal(len(_KERNEL) - 1)
        self._gain: list[float] = []
        self._tremor: list[float] = []
        self._frame = 0
        self._error = 0.0
        self._correction = 0.0
        self._target = 0.0
        self._past_target = 0.0
        self._missing: deque[float] = deque()
        self._draw_block()

    def act(self, observation: Observation) -> Action:
        """Return the hand's reference height [m] in each of the next n frames."""
        target = observation[HumanObservation.TARGET].tolist()
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

        # Over the step the correction changes at a constant rate.
        current, change = self._correction, (correction - self._correction) / n
        error, before = self._error, self._target
        reference = []
        for height, gain, tremor in zip(
            target, self._gain[start:stop], self._tremor[start:stop], strict=True
        ):
            error = self._kept * error + gain * (height - before)
            current += change
            reference.append(height + error + tremor + current)
            before = height

        self._frame = stop
        self._correction = correction
        self._error = error
        self._target = before
        self._past_target = target[-1 - age]
        return np.array(reference)

    def _draw_block(self) -> None:
        """Draw the noise of the next ``BLOCK`` frames."""
        white = np.concatenate((self._white, self._rng.standard_normal(BLOCK)))
        self._white = white[BLOCK:]
        smooth = dot(np.lib.stride_tricks.sliding_window_view(white, len(_KERNEL)), _KERNEL)
        first = len(self._tremor)
        omega = 2.0 * np.pi * self.subject.tremor_frequency
        time = FRAME * np.arange(first, first + BLOCK)
        tremor = self.subject.tremor_amplitude * each(math.sin, omega * time + self._phase)
        self._gain += (self.subject.motor_noise * smooth).tolist()
        self._tremor += tremor.tolist()
