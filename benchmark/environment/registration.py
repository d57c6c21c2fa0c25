"""Registration with Gymnasium."""

import gymnasium


def register() -> None:
    """Register ``colift/Lift-v0``, once."""
    if "colift/Lift-v0" not in gymnasium.registry:
        gymnasium.register(
            id="colift/Lift-v0",
            entry_point="colift.benchmark.environment.single:RobotEnv",
        )
