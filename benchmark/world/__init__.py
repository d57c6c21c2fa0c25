"""The physical world: a human and a far end, coupled by a table, in PyBullet."""
