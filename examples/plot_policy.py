"""
A policy of ten lines
=====================

A policy written in this script, its score, and a picture of one of its lifts. A class with
``reset`` and ``act`` is a policy; nothing has to be registered.
"""

import colift
from colift.agents.agent import RobotObservation
from colift.benchmark.rendering.film import still_picture
from matplotlib import pyplot as plt


class Follow:
    """Go beyond the human's last height by 1.5 times its last change."""

    def reset(self, seed):
        """Begin a lift."""
        self.last = 0.0

    def act(self, observation):
        """Return the change of the hand command [m]."""
        human = observation[RobotObservation.HUMAN_END]
        goal = human + 1.5 * (human - self.last)
        self.last = human
        return [goal - observation[RobotObservation.HAND_HEIGHT]]


# %%
# The score of a lift is the RMSE of the height difference between the table's ends.

found = colift.evaluate(Follow, suite="quick-v1")
found

# %%
# The first lift at its start, at the largest difference, and at the human's highest point.

episode, scenario = found.run.episodes[0], found.run.suite.scenarios[0]
figure = plt.figure(figsize=(10, 6.9))
figure.add_axes((0, 0, 1, 1)).imshow(still_picture(episode, scenario, "Follow"))
plt.axis("off")
plt.show()
