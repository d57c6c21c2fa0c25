"""People who steer a ball on the table while they lift it."""

from colift.agents.tasks.ball.manner import MANNERS, SteeringManner, steering_manner
from colift.agents.tasks.ball.person import Steers
from colift.agents.tasks.ball.places import (
    BallPause,
    BallPauseShared,
    BallPlan,
    BallSmooth,
    BallSmoothShared,
    Placing,
)
from colift.agents.tasks.ball.second import BallPartner, BallSenses, with_ball

__all__ = [
    "MANNERS",
    "BallPartner",
    "BallPause",
    "BallPauseShared",
    "BallPlan",
    "BallSenses",
    "BallSmooth",
    "BallSmoothShared",
    "Placing",
    "SteeringManner",
    "Steers",
    "steering_manner",
    "with_ball",
]
