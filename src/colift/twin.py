"""The twin as an environment: ``env = colift.twin.make("ball")`` (extra: ``train``).

===================== ==============================================================================
name                  what it is
===================== ==============================================================================
:func:`make`          the environment of a task, as JaxMARL's are: dictionaries by agent
:class:`TwinEnv`      its class: ``reset(key)``, ``step(key, state, actions)``
:class:`Single`       the robot alone, as gymnax's environments are
:class:`TrainingView` an environment in the form that suits learners best; writes submissions
:class:`State`        the state of an environment, a tree of arrays
:class:`Box`          its spaces
===================== ==============================================================================

The import imports JAX, and no physics engine. The device is JAX's own choice, unless it was chosen
before.
"""

from colift.benchmark.twin.libraries import require_jax

require_jax()

from colift.benchmark.twin_environment.environment import State, TwinEnv  # noqa: E402
from colift.benchmark.twin_environment.made import make  # noqa: E402
from colift.benchmark.twin_environment.single import Single  # noqa: E402
from colift.benchmark.twin_environment.spaces import Box  # noqa: E402
from colift.benchmark.twin_environment.training_view import TrainingView  # noqa: E402

__all__ = ["Box", "Single", "State", "TrainingView", "TwinEnv", "make"]
