"""``colift nao watchdog``: the release of a robot whose client is gone, from another machine."""

from typing import Annotated

import typer
from colift.agents.hardware.nao.session import leave
from colift.agents.hardware.operator import StopButton, armed
from colift.agents.hardware.ports import RobotLostError
from colift.agents.hardware.stops import Stop
from colift.agents.hardware.terminal import tell
from colift.agents.hardware.watchdog import watch
from colift.cli.nao.connections import URL, describe_robot, open_robot


def watch_robot(
    robot: Annotated[str, typer.Option(metavar="URL", help="Address of the robot's NAOqi.")] = URL,
) -> None:
    """Release the robot's arms when the client that claims it is gone, until Ctrl-C.

    'colift nao run' starts a watchdog of its own. This one is for another machine: it also acts
    when the machine of the client, or its network, fails.

    Example: colift nao watchdog --robot tcp://nao.local:9559
    """
    arm, button = open_robot(robot), StopButton()
    tell(f"watching the robot {describe_robot(arm.session)}, until Ctrl-C")
    with armed(button):
        try:
            watch(arm, button.wait)
        except RobotLostError as error:
            tell(f"the robot is lost: {error}")
            leave(int(Stop.ROBOT_LOST))
    leave(0)
