"""Set-up of PyBullet: clients, solver, models."""

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.benchmark.world.bullet import pybullet, silent
from colift.benchmark.world.interface import Engine
from colift.benchmark.world.physics import Physics
from colift.benchmark.world.table import GRAVITY


@dataclass(frozen=True, kw_only=True)
class BulletEngine(Engine):
    """A simulation in PyBullet."""

    client: int
    table: int
    """Body of the table."""


Vector = tuple[float, float, float]

DIRECT: Final = {
    "constraintSolverType": pybullet.CONSTRAINT_SOLVER_LCP_DANTZIG,
    "globalCFM": 1e-9,
    "numSolverIterations": 1,
}
"""Dantzig's pivoting solves the constraints of a step exactly, up to a compliance of 1e-9.

Arm and table form a closed loop with redundant constraints: without compliance the problem is
singular, and the engine falls back to iterations. A compliance ten times larger or smaller changes
no RMSE by more than 5e-6 of its value. The number of iterations is that of
the fall-back, which never occurs.
"""


def new_client(physics: Physics) -> int:
    """Return a new headless physics client with gravity, time step and solver set."""
    client: int = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -GRAVITY, physicsClientId=client)
    solver = {"numSolverIterations": physics.iterations} if physics.iterations else DIRECT
    with silent():  # PyBullet reports each change of the solver.
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=physics.step, physicsClientId=client, **solver
        )
    return client


def load_urdf_text(client: int, text: str, position: Vector) -> int:
    """Load a robot with a fixed base and the inertias of its URDF text, and return its body.

    The engine's own damping of velocities is switched off: the models state all damping.
    """
    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
        file.write(text)
        file.flush()
        return load_urdf(client, Path(file.name), position)


def load_urdf(client: int, path: Path, position: Vector) -> int:
    """Load the robot of a URDF file, as :func:`load_urdf_text`."""
    body: int = pybullet.loadURDF(
        str(path),
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


def pin(client: int, hand: tuple[int, int], table: tuple[int, int], point: Vector) -> None:
    """Pin a hand to the table, bodies and links, at a point of the world [m]."""
    anchors = []
    for body, link in (hand, table):
        state = pybullet.getLinkState(
            body, link, computeForwardKinematics=1, physicsClientId=client
        )
        inverse = pybullet.invertTransform(state[0], state[1])
        anchors.append(pybullet.multiplyTransforms(*inverse, point, (0, 0, 0, 1))[0])
    pybullet.createConstraint(
        *hand,
        *table,
        pybullet.JOINT_POINT2POINT,
        (0, 0, 0),
        *anchors,
        physicsClientId=client,
    )


def disconnect(client: int) -> None:
    """Disconnect a client; do nothing if it is gone already."""
    if pybullet.isConnected(physicsClientId=client):
        pybullet.disconnect(physicsClientId=client)
