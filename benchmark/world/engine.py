"""The few calls that set PyBullet up, each told which client it means."""

import tempfile
from typing import Final

from .bullet import pybullet, silent
from .physics import Physics
from .table import GRAVITY

Vector = tuple[float, float, float]

DIRECT: Final = {
    "constraintSolverType": pybullet.CONSTRAINT_SOLVER_LCP_DANTZIG,
    "globalCFM": 1e-9,
    "numSolverIterations": 1,
}
"""Dantzig's pivoting solves the constraints of a step exactly, up to a compliance of 1e-9.

Two arms and a table are a closed loop, some of whose constraints say the same: without compliance
the problem is singular, and the engine would fall back to iterations. One hundred times more or ten
times less changes no RMSE by more than 2e-6 of its value. The number of iterations is that of the
fall-back, which never happens.
"""


def new_client(physics: Physics) -> int:
    """Return a new headless physics client with gravity, time step and solver set."""
    client: int = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -GRAVITY, physicsClientId=client)
    solver = {"numSolverIterations": physics.iterations} if physics.iterations else DIRECT
    with silent():  # It tells of each change of the solver.
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=physics.step, physicsClientId=client, **solver
        )
    return client


def load_urdf_text(client: int, text: str, position: Vector) -> int:
    """Load a robot with a fixed base and the inertias of its URDF text, and return its body.

    The engine's own damping of velocities is switched off: what damps is stated in the models.
    """
    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
        file.write(text)
        file.flush()
        body: int = pybullet.loadURDF(
            file.name,
            position,
            useFixedBase=True,
            flags=pybullet.URDF_USE_INERTIA_FROM_FILE,
            physicsClientId=client,
        )
    for link in range(-1, pybullet.getNumJoints(body, physicsClientId=client)):
        pybullet.changeDynamics(
            body, link, linearDamping=0, angularDamping=0, jointDamping=0, physicsClientId=client
        )
    return body


def disconnect(client: int) -> None:
    """Disconnect a client; one that is gone already is left alone."""
    if pybullet.isConnected(physicsClientId=client):
        pybullet.disconnect(physicsClientId=client)
