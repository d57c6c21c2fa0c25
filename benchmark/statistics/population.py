r"""A model of errors of policies with drawn people, of which all true means are known.

The logarithm of the error of policy p, in a lift with person u in behaviour b, is

.. math:: \ln e_{pub} = \ln m_p + \beta_b + a_u + c_{pu} + l_{ub} + r_{pub}

with normal deviates: :math:`a_u` how difficult a person is, :math:`c_{pu}` how well a policy suits
the person, :math:`l_{ub}` how difficult a lift is, :math:`r_{pub}` the rest. All policies share
:math:`a` and :math:`l`, as they share people and plans. Errors are therefore skewed, and differ
more with difficult people.
"""

from dataclasses import dataclass

import numpy as np
from colift.benchmark.statistics.samples import FloatArray
from colift.benchmark.statistics.units import Units


@dataclass(frozen=True, kw_only=True)
class ErrorModel:
    """Standard deviations of the parts of a log error, and the mean error of each behaviour."""

    behaviours_mm: tuple[float, ...]
    """Geometric mean error in each behaviour [mm], for a policy of scale 1."""
    person: float
    suiting: float
    """Of policy and person."""
    lift: float
    rest: float

    def draw(self, scales: FloatArray, people: int, rng: np.random.Generator) -> FloatArray:
        """Return errors [mm] of policies of these scales, shape (policies, people x behaviours).

        Each person plays every behaviour once.
        """
        many, ways = len(scales), len(self.behaviours_mm)
        common = (
            np.log(self.behaviours_mm)
            + self.person * rng.standard_normal((people, 1))
            + self.lift * rng.standard_normal((people, ways))
        )
        own = self.suiting * rng.standard_normal((many, people, 1))
        own = own + self.rest * rng.standard_normal((many, people, ways))
        found: FloatArray = scales[:, None, None] * np.exp(common + own)
        return found.reshape(many, -1)

    def units(self, people: int) -> Units:
        """Return the people of :meth:`draw`."""
        ways = range(len(self.behaviours_mm))
        return Units.people((way, person) for person in range(people) for way in ways)

    @property
    def mean_mm(self) -> float:
        """True mean error of a policy of scale 1 [mm]."""
        variance = sum(part**2 for part in (self.person, self.suiting, self.lift, self.rest))
        return float(np.mean(self.behaviours_mm) * np.exp(0.5 * variance))
