"""Touch: the table as the robot's hands feel it, and a learned control law that uses it."""
