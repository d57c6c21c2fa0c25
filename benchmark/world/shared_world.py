"""A world in which one person takes over from another."""

from .bullet import pybullet
from .bullet_world import BulletWorld
from .human_body import BodyParameters, HumanBody
from .table import HANDS, SLIDE
from .world import FarEnd


class SharedWorld(BulletWorld):
    """A world that can take one person after another: a new world takes 20 ms.

    The person's mass is changed in the engine; with it, everything is as in a new world, bit for
    bit.
    """

    def with_person(self, human: BodyParameters, far_end: FarEnd) -> "SharedWorld":
        """Exchange the person, and return the world, which is to be reset.

        Parameters
        ----------
        human
            The next person.
        far_end
            The holder of the far end, who stays.
        """
        for link in (SLIDE, HANDS):
            inertia = pybullet.getDynamicsInfo(self._tree, link, physicsClientId=self.client)[2]
            pybullet.changeDynamics(
                self._tree,
                link,
                mass=human.mass,
                localInertiaDiagonal=inertia,  # Else the engine derives one from the mass.
                physicsClientId=self.client,
            )
        self._mass = human.mass
        self._body = HumanBody(human, self._step)
        return self
