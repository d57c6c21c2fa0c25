"""
The environment's loop
======================

Both ends of the table are agents of a PettingZoo environment, and each step rewards both of them.
Here the scripted human lifts, and the robot removes the difference that it observes.
"""

import colift
import numpy as np
from colift.agents.agent import RobotObservation
from colift.benchmark.rendering.style import HUMAN, ROBOT, style_axes
from matplotlib import pyplot as plt

env = colift.parallel_env(behaviour="changing_goal", subject="S2")
observations, _ = env.reset(seed=8)
human = env.scripted_human()
rewards, times, heights = [], [], []
while env.agents:
    seen = observations["robot"]
    change = 1.8 * (seen[RobotObservation.HUMAN_END] - seen[RobotObservation.HAND_HEIGHT])
    actions = {"human": human.act(observations["human"]), "robot": np.array([change])}
    observations, reward, _, _, _ = env.step(actions)
    rewards.append((reward["human"], reward["robot"]))
    times.append(observations["robot"][RobotObservation.TIME])
    heights.append(observations["robot"][:2])
env.close()

# %%
# A reward is the negative distance from the agent's goal, in metres: the robot's goal is a level
# table, the human's is that and the intended height. The robot sees samples that are 100 ms old.

figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 5), sharex=True, layout="constrained")
for name, colour, height, reward in zip(
    ("human", "robot"), (HUMAN, ROBOT), np.transpose(heights), np.transpose(rewards), strict=True
):
    upper.plot(times, 1000 * height, color=colour, label=f"{name}'s end")
    lower.step(times, 1000 * reward, color=colour, label=name, where="pre")
upper.set_ylabel("observed height [mm]")
lower.set(xlabel="time [s]", ylabel="reward [mm]", xlim=(0, times[-1]))
for axes in (upper, lower):
    style_axes(axes)
upper.legend(frameon=False)
lower.legend(frameon=False, loc="lower right", ncols=2)
plt.show()
