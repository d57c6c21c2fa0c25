"""Goes where the human is about to be."""

from ..control.anticipation import load_anticipation
from ..control.anticipation_controller import AnticipateParameters, AnticipationController


class Anticipate(AnticipationController):
    """Foresees the human's next half second, and commands what keeps the table level in it (ours).

    Three parts, each with the reason why it is there (``docs/anticipate.md`` shows what is lost
    without it):

    **Foresight.** A small perceptron, learned in simulated lifts, maps the last two seconds of the
    human's end to the mean of its coming heights h(t). It does at once what several models would
    have to be mixed for: it has seen onsets, pauses, reversals and fits and starts, and knows how
    they go on. It sees nothing of the robot itself: neither its commands nor the sag of its hand
    tell more of the human than the human's end does.

    **The arm.** It follows its command by a known lag, and sags under its load by what differs
    along the stroke. The path to command is

        p(t) = h(t + ARM_LAG) + sag,

    with the sag measured by the hand's encoders and smoothed. No number of the arm is learned.

    **Preview control.** The command is the first of those that keep the height difference over the
    coming periods least, at a cost for bends (:func:`.preview_gains`). Over a period the command
    can only ramp: so it aims not where the human will be at the end of the period, but where the
    whole of the ramps to come fits the whole of the path. The cost trades level for smooth.

    How much is level by foresight, and how much by following, is told in the trace.
    """

    def __init__(self, *, parameters: AnticipateParameters | None = None) -> None:
        parameters = parameters or AnticipateParameters()
        super().__init__(load_anticipation(parameters.model), parameters)

    def internals(self) -> dict[str, float]:
        """Return what the last action was based on.

        Prediction of the human's end at the end of the period [m], and its velocity there [m/s];
        ``predicted_end``, the height at which the stroke in progress ends [m]; the probabilities of
        rest, onset, stroke, pause and reversal (:data:`.MODES`); the sag that is made up for [m].
        Confidence t^2 / (t^2 + s^2), with s^2 the mean squared error of the latest predictions and
        t the tolerance. Role, the share of foresight in the change of the command: what it would
        not be, were the human to stay where it was seen last; 0 follows, 1 leads.
        """
        return super().internals()
