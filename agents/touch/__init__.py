"""Touch: the table as the robot's hands feel it, and a learned law of control by it."""
