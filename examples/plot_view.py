"""
The lift in three dimensions
============================

The environment draws itself as other environments do: ``render_mode="rgb_array"`` gives an image
of the lift after any step. The robot on the left never moves here, so the table tilts.
"""

import colift
import numpy as np
from matplotlib import pyplot as plt

env = colift.parallel_env(behaviour="smooth", subject="S5", render_mode="rgb_array")
observations, _ = env.reset(seed=2)
human = env.scripted_human()
images = []
for step in range(41):
    if step % 20 == 0:
        images.append(env.render())
    actions = {"human": human.act(observations["human"]), "robot": np.zeros(1)}
    observations, *_ = env.step(actions)
env.close()

# %%
# Drawing a lift does not change it: the pictures come from an engine of their own.

figure = plt.figure(figsize=(10, 2.5), layout="constrained")
for panel, image, time in zip(figure.subplots(1, 3), images, (0.0, 2.0, 4.0), strict=True):
    panel.imshow(image)
    panel.set_title(f"{time:.1f} s", loc="left", fontsize=10)
    panel.axis("off")
plt.show()
