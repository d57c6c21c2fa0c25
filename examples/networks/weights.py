"""The weights of a PyTorch network of linear layers, for ``numpy_policy.py`` beside this file."""

import numpy as np
import torch

net = torch.nn.Sequential(torch.nn.Linear(4, 32), torch.nn.Tanh(), torch.nn.Linear(32, 1))
# Train it here.
arrays = {}
for i, layer in enumerate(each for each in net if isinstance(each, torch.nn.Linear)):
    arrays[f"w{i}"] = layer.weight.detach().numpy()
    arrays[f"b{i}"] = layer.bias.detach().numpy()
np.savez("mine/weights.npz", **arrays)
