"""The NAO robot: published facts, the URDF made from them, and the kinematics of its arms."""
