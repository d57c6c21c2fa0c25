"""What results come from: named, compared, and found to differ."""

import pytest
from colift.base.errors import InputError
from colift.benchmark.execution.provenance import (
    check_same_origin,
    fingerprint,
    origin,
    platform_of,
)


def test_an_origin_is_the_platform_and_colift():
    assert platform_of(origin()) == fingerprint()
    assert set(origin()) == {*fingerprint(), "colift"}


def test_equal_origins_pass_and_only_what_is_wanted_is_compared():
    check_same_origin(origin(), origin(), "here", "here")
    check_same_origin(origin(), {"python": origin()["python"]}, "here", "there")


@pytest.mark.parametrize("found", [{"numpy": "2", "libc": "b"}, {"numpy": "2"}])
def test_the_first_difference_is_named(found):
    told = f"libc is {found.get('libc')!r} on worker 3 and 'a' here"
    with pytest.raises(InputError, match=told):
        check_same_origin(found, {"numpy": "2", "libc": "a"}, "on worker 3", "here")
