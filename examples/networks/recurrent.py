"""A recurrent PyTorch network as an ONNX file, with its state as an input and an output."""

import torch


class Robot(torch.nn.Module):
    """A policy with a memory."""

    def __init__(self):
        super().__init__()
        self.cell = torch.nn.GRUCell(5, 32)
        self.head = torch.nn.Linear(32, 1)

    def forward(self, observation, state):
        """Return the action [m] (1, 1) and the new state (1, 32)."""
        state = self.cell(observation, state)
        return 0.04 * torch.tanh(self.head(state)), state


robot = Robot()
# Train it here.
torch.onnx.export(
    robot,
    (torch.zeros(1, 5), torch.zeros(1, 32)),
    "policy.onnx",
    opset_version=18,
    input_names=["observation", "state"],
    output_names=["action", "new_state"],
    external_data=False,
)
