"""Linear extrapolation with a smoothed velocity."""


class Policy:
    """Goes to the height that the human's end will have reached after a lead time.

    ``lead`` [s] makes up for the age of the data, and for the time that the hands need.
    """

    def __init__(self, lead=0.3):
        self.lead = lead

    def reset(self, seed):
        """Begin a lift."""
        self.last = 0.0
        self.velocity = 0.0

    def act(self, observation):
        """Return the change of the hands' height [m] in this step."""
        human_end, robot_end, hand, command, time = observation
        self.velocity += 0.5 * ((human_end - self.last) / 0.1 - self.velocity)
        self.last = human_end
        return human_end + self.lead * self.velocity - command
