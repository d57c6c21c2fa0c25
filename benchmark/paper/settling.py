"""How fast the confidence finds rest when the human does (figure 7)."""

from .measures import settling_steps
from .replay import confidence_course, replay
from .sampled import SampledLift


def settling(lift: SampledLift, forgetting: float, *, staying: bool = False) -> int:
    """Return after how many steps of the human's pause the confidence has settled.

    Computed offline from the lift's samples; see :func:`.settling_steps`.

    Parameters
    ----------
    lift
        A lift with a long pause.
    forgetting
        phi of eq. 7.
    staying
        Whether to wait for the last departure, noise included, instead of the first arrival.
    """
    replayed = replay(lift.samples, lift.scenario.control_period)
    course = confidence_course(replayed.likelihood, forgetting)
    start, stop = (lift.step_showing(lift.event(event)) for event in ("pause", "resume"))
    return settling_steps(course[start:stop], staying=staying)
