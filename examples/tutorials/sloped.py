"""A policy for a table with a slope."""


class Policy:
    """Goes to where the human's end is seen, less the rise, and a little ahead."""

    def reset(self, seed):
        self.last = 0.0

    def act(self, observation):
        human_end, robot_end, hand, command, time, rise = observation
        ahead = human_end + 1.5 * (human_end - self.last)
        self.last = human_end
        return ahead - rise - command
