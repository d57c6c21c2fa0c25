"""A policy with two gains."""


class Policy:
    """Move the hand to the extrapolated height of the human's end."""

    def __init__(self, gain: float = 0.6, lead: float = 0.0) -> None:
        self.gain = gain
        self.lead = lead

    def reset(self, seed):
        self.before = 0.0

    def act(self, observation):
        human_end, robot_end, hand, command, time = observation
        velocity = (human_end - self.before) / 0.1
        self.before = human_end
        return [self.gain * (human_end + self.lead * velocity - hand)]
