"""What the tests of several packages share."""

import pytest
from colift.benchmark.loopback import loopback_cluster


@pytest.fixture(scope="session")
def dask_address():
    """Start a Dask scheduler and two worker processes, and return the scheduler's address."""
    with loopback_cluster(2) as address:
        yield address
