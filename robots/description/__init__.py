"""URDF parts of any robot: parsing, welding, rotations."""
