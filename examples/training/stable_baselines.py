"""
PPO of Stable-Baselines3
========================

A policy is trained in the engine by PPO, and scored on the quick suite. The CPU build of PyTorch is
enough, and smaller than the default build::

    pip install torch --index-url https://download.pytorch.org/whl/cpu
    pip install stable-baselines3

It takes five minutes of one processor core, and is not run by the tests or with the documentation.
With PyTorch 2.13.0, Stable-Baselines3 2.9.2 and Gymnasium 1.4.0 it printed an RMSE of 6.26 mm.
"""

import colift
import numpy as np
from colift.agents.submissions.training_view import TrainingView
from colift.benchmark.environment import training_view
from stable_baselines3 import PPO
from stable_baselines3.common.env_util import make_vec_env

STEPS = 20  # Steps of the human's motion that the policy sees.


class Trained:
    """The trained network as a policy of the benchmark, in the view in which it was trained."""

    def __init__(self, model: PPO) -> None:
        self.model = model
        self.view = TrainingView(model.observation_space.shape[0])

    def reset(self, seed: int) -> None:
        """Begin a lift."""
        self.view.reset()

    def act(self, observation: np.ndarray) -> np.ndarray:
        """Return the change of the hands' height [m]."""
        action, _ = self.model.predict(self.view.seen(observation), deterministic=True)
        return self.view.change(action)


if __name__ == "__main__":
    envs = make_vec_env(
        "colift/Lift-v0",
        n_envs=8,
        seed=0,
        env_kwargs={"behaviour": "any", "subject": "draw", "reward": "score"},
        wrapper_class=training_view,
        wrapper_kwargs={"steps": STEPS},
    )
    model = PPO(
        "MlpPolicy",
        envs,
        n_steps=512,
        batch_size=256,
        gamma=0.9,
        gae_lambda=0.9,
        policy_kwargs={"log_std_init": np.log(0.3)},
        seed=0,
        device="cpu",
        verbose=1,
    )
    model.learn(200_000)
    model.save("ppo_colift")
    envs.close()
    print(colift.evaluate(Trained(model), suite="quick-v1"))
