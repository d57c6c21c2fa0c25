"""Seeds for the roles of an episode, derived by a keyed hash.

A role gets an integer, never a generator, since a spawned NumPy generator reveals its parent's
entropy.
"""

import hashlib

SEED_BITS = 63


def derive_seed(seed: int, role: str) -> int:
    """Return the seed of ``role`` in the episode ``seed``: BLAKE2b of both.

    The roles' seeds are independent of each other, and the same in any process and on any platform.

    Parameters
    ----------
    seed
        The episode's seed, any integer.
    role
        Name of the role, such as ``"plan"`` or ``"sensor"``.
    """
    message = f"{seed}/{role}".encode()
    digest = hashlib.blake2b(message, digest_size=8, person=b"colift").digest()
    return int.from_bytes(digest, "big") >> (64 - SEED_BITS)
