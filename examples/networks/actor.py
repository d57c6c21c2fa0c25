"""The actor of a model of Stable-Baselines3 as an ONNX file."""

import torch
from stable_baselines3 import PPO


class Actor(torch.nn.Module):
    """The action alone, without value and probability."""

    def __init__(self, policy):
        super().__init__()
        self.policy = policy

    def forward(self, observation):
        """Return the action (1, 1)."""
        return self.policy(observation, deterministic=True)[0]


torch.onnx.export(
    Actor(PPO.load("model.zip").policy),
    torch.zeros(1, 27),
    "policy.onnx",
    opset_version=17,
    dynamo=False,
    input_names=["observation"],
    output_names=["action"],
)
