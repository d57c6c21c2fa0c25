"""The few calls that set PyBullet up, each told which client it means."""

import tempfile

from .bullet import pybullet
from .physics import Physics
from .table import GRAVITY

Vector = tuple[float, float, float]


def new_client(physics: Physics) -> int:
    """Return a new headless physics client with gravity, time step and solver set."""
    client: int = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -GRAVITY, physicsClientId=client)
    pybullet.setPhysicsEngineParameter(
        fixedTimeStep=physics.step,
        numSolverIterations=physics.iterations,
        physicsClientId=client,
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
