"""People who steer a ball on the table while they lift it."""

from colift.agents.humans.ball.manner import MANNERS, SteeringManner, steering_manner
from colift.agents.humans.ball.places import (
    BallPause,
    BallPauseShared,
    BallPlan,
    BallSmooth,
    BallSmoothShared,
    Placing,
)
from colift.agents.humans.ball.steerer import BallPartner, BallSenses, Steerer, with_ball

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
    "Steerer",
    "SteeringManner",
    "steering_manner",
    "with_ball",
]
