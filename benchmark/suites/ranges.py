"""The ranges of drawn people, and what each is for.

A person is ``draw-K`` (:meth:`.Subject.draw`); K is the person's number. No two ranges overlap,
apart from the parts of :data:`LEARNING_PEOPLE`, so that a score holds for people on whom nothing
was learned or tuned. A suite of another package may have any people outside
:data:`LEARNING_PEOPLE`. Hidden people have numbers of 128 bits (:mod:`.hidden`).
"""

from typing import Final

QUICK_PEOPLE: Final = range(1, 4)
"""People of ``quick-v1``."""

STANDARD_PEOPLE: Final = range(101, 176)
"""People of ``standard-v1``."""

AGREE_PEOPLE: Final = range(201, 226)
"""People of ``agree-v1``."""

BALL_PEOPLE: Final = range(301, 326)
"""People of ``ball-v1``."""

INTENT_PEOPLE: Final = range(401, 426)
"""People of ``intent-v1``."""

ROBUST_PEOPLE: Final = range(501, 541)
"""People of ``robust-v1``."""

SESSION_PEOPLE: Final = range(601, 641)
"""People of ``session-v1``."""

RECORDED_PEOPLE: Final = range(1_001, 2_001)
"""People whose bodies recorded motion has, in turn."""

LEARNING_PEOPLE: Final = range(60_000, 200_000)
"""People, and seeds of their lifts, to learn from and to tune on. The next three are its parts."""

DEMONSTRATING_PEOPLE: Final = range(60_000, 80_000)
"""People of ``colift demonstrate``, from whom ``task_model`` learns."""

PRACTISING_PEOPLE: Final = range(80_000, 100_000)
"""People with whom ``task_model`` practises."""

TRAINING_PEOPLE: Final = range(100_000, 200_000)
"""People of ``colift train``, of environments that draw people, and of exported sets."""

FIRST_NEW_PERSON: Final = 200_000
"""The first person of studies and tests of what was learned; so are all after it."""
