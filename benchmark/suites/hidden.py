"""Hidden suites: people and plans derived from a season secret.

The behaviours are the public ones; everything else is new. Without the secret, the derived seeds
cannot be distinguished from random ones. The commitment, published beforehand, proves afterwards
that the board did not choose its secret to favour anyone.
"""

import dataclasses
import hashlib
import hmac
import secrets
from typing import Final

from colift.agents.humans import Subject
from colift.base.errors import InputError
from colift.benchmark.suites.suite import Suite

SECRET_BYTES: Final = 32
"""Length of a new secret [bytes]: as many bits as a hash of SHA-256."""

SEED_BYTES: Final = 16
"""Length of a hidden seed [bytes]: 128 bits, beyond any search."""


def new_secret() -> bytes:
    """Return a new secret from the operating system's entropy."""
    return secrets.token_bytes(SECRET_BYTES)


def commitment(secret: bytes) -> str:
    """Return SHA-256(secret), 64 hexadecimal digits: it may be published and reveals nothing."""
    return hashlib.sha256(_checked(secret)).hexdigest()


def keyed(secret: bytes, *labels: str | int) -> bytes:
    """Return HMAC-SHA256(secret, labels): 32 bytes for each purpose, equal on any machine.

    Raises
    ------
    InputError
        If the secret is shorter than :data:`SECRET_BYTES`.
    """
    message = "\0".join(map(str, labels)).encode()
    return hmac.new(_checked(secret), message, hashlib.sha256).digest()


def hidden_suite(suite: Suite, secret: bytes) -> Suite:
    """Return the hidden counterpart of a public suite, of the same size.

    Each person p of the suite is replaced by a new one, the same in all of p's scenarios, and the
    lifts k have new seeds:

        person(p) = Subject.draw(HMAC(secret, "person", suite's name and digest, name of p))
        seed(k) = HMAC(secret, "lift", suite's name and digest, k)

    128 bits each. Plan and noise of a lift follow from its seed and the scenario's name
    (:meth:`.Lift.reset`), and the person's seed is in that name, so that each lift of each scenario
    has its own random numbers.

    Parameters
    ----------
    suite
        The public suite.
    secret
        The board's secret.
    """
    place = (suite.name, suite.digest)
    people = {
        name: Subject.draw(_seed(secret, "person", *place, name))
        for name in dict.fromkeys(scenario.subject.name for scenario in suite.scenarios)
    }
    scenarios = tuple(
        dataclasses.replace(scenario, subject=people[scenario.subject.name])
        for scenario in suite.scenarios
    )
    seeds = tuple(_seed(secret, "lift", *place, k) for k in range(len(suite.seeds)))
    return Suite(name=f"{suite.name} (hidden)", scenarios=scenarios, seeds=seeds)


def _seed(secret: bytes, *labels: str | int) -> int:
    return int.from_bytes(keyed(secret, *labels)[:SEED_BYTES], "big")


def _checked(secret: bytes) -> bytes:
    if len(secret) < SECRET_BYTES:
        raise InputError(f"the secret has {len(secret)} bytes; it needs at least {SECRET_BYTES}")
    return secret
