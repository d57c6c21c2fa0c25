"""Robot policies: what moves the robot's hands, from what a robot may see."""
