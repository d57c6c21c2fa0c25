"""The NAO: its facts, shapes, arm kinematics and URDF."""
