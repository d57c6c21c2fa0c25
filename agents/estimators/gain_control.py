"""Behaviour gain control: who leads (equation 8)."""


def gain_control(confidence: float, proactive: float, reactive: float) -> float:
    """Return the composite action, A = C P + (1 - C) R (eq. 8).

    Parameters
    ----------
    confidence
        C in [0, 1]: 1 leads, 0 follows.
    proactive, reactive
        Actions P and R [m].

    Raises
    ------
    ValueError
        If the confidence is outside [0, 1].
    """
    if not 0 <= confidence <= 1:
        raise ValueError(f"confidence must be in [0, 1], got {confidence}")
    return confidence * proactive + (1 - confidence) * reactive
