"""The gains of a policy, by the cross-entropy method."""

from pathlib import Path

import colift
import numpy as np
from gains import Policy
from matplotlib import pyplot as plt

BEHAVIOURS = "smooth", "pause", "jerky", "changing_goal"
GENERATIONS, CANDIDATES, ELITE, LIFTS = 5, 10, 3, 4
TEST = range(190_000, 190_008)


def error(gains, seeds):
    """Return the mean RMSE of one lift per seed [mm]."""
    errors = []
    for seed in seeds:
        env = colift.make(BEHAVIOURS[seed % 4], subject=f"draw-{seed}")
        policy = Policy(*gains)
        policy.reset(0)
        observation, _ = env.reset(seed=seed)
        rewards, ended = [], False
        while not ended:
            action = np.array(policy.act(observation))
            observation, reward, terminated, truncated, _ = env.step(action)
            rewards.append(reward)
            ended = terminated or truncated
        env.close()
        errors.append(1000 * np.sqrt(np.mean(np.square(rewards))))
    return np.mean(errors)


rng = np.random.default_rng(0)
mean, spread = np.array([0.6, 0.0]), np.array([0.3, 0.1])
curve = [error(mean, TEST)]
for generation in range(GENERATIONS):
    first = 100_000 + LIFTS * generation
    candidates = rng.normal(mean, spread, (CANDIDATES, 2))
    errors = [error(gains, range(first, first + LIFTS)) for gains in candidates]
    elite = candidates[np.argsort(errors)[:ELITE]]
    mean, spread = elite.mean(axis=0), elite.std(axis=0) + (0.05, 0.02)
    curve.append(error(mean, TEST))
    print(f"gain {mean[0]:.2f}, lead {mean[1]:.3f} s: RMSE {curve[-1]:.1f} mm")

Path("gains.txt").write_text(f"gain={mean[0]:.3f},lead={mean[1]:.3f}")

figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
axes.plot(curve, marker="o")
axes.set(xlabel="generation", ylabel="RMSE [mm]", ylim=(0, None))
axes.grid(alpha=0.3)
figure.savefig("curve.png", dpi=150)
