"""A world in which one person replaces another."""

from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.human_body import BodyParameters, HumanBody
from colift.benchmark.world.table import HANDS, SLIDE
from colift.benchmark.world.world import FarEnd


class SharedWorld(BulletWorld):
    """A world for one person after another, since making a new world takes 20 ms.

    The person's mass is changed in the engine; everything is then as in a new world, bit for bit.
    """

    def with_person(self, human: BodyParameters, far_end: FarEnd) -> "SharedWorld":
        """Exchange the person, and return the world, which must then be reset.

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
                localInertiaDiagonal=inertia,  # Otherwise derived from the mass.
                physicsClientId=self.client,
            )
        self._mass = human.mass
        self._body = HumanBody(human, self._step)
        return self
