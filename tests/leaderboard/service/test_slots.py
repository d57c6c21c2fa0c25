"""Places that clients share: none has more than its own, and who waits too long is told so."""

import asyncio
from contextlib import AsyncExitStack

import pytest
from colift.leaderboard.service.slots import Slots
from starlette.exceptions import HTTPException

MINE, FULL = (429, 10), (503, 10)
"""Status, and when to come again."""


def taken(slots, *clients):
    """Take a place for each, one after the other; return what each was told, and then all end."""

    async def take():
        told = []
        async with AsyncExitStack() as stack:
            for client in clients:
                try:
                    await stack.enter_async_context(slots.held(client))
                    told.append(200)
                except HTTPException as error:
                    told.append((error.status_code, int(error.headers["Retry-After"])))
        return told

    return asyncio.run(take())


def test_one_client_has_its_own_places_and_all_together_no_more_than_there_are():
    slots = Slots(what="uploads", each=2, total=3, patience_s=0.0)
    assert taken(slots, "a", "a", "a", "b", "b", "c") == [200, 200, MINE, 200, FULL, FULL]
    assert taken(slots, "a", "a", "a", "b") == [200, 200, MINE, 200]  # All were given back.
    assert slots._clients == {}


def test_who_waits_gets_the_place_that_becomes_free():
    slots = Slots(what="uploads", each=1, total=1, patience_s=10.0)
    order = []

    async def use(name, seconds):
        async with slots.held("a"):
            order.append(name)
            await asyncio.sleep(seconds)

    async def all_of_them():
        await asyncio.gather(*(use(name, 0.01) for name in "123"))

    asyncio.run(all_of_them())
    assert order == ["1", "2", "3"]


def test_a_place_is_given_back_whatever_happens_there():
    slots = Slots(what="uploads", each=1, total=1, patience_s=0.0)

    async def fail():
        async with slots.held("a"):
            raise ValueError("the client is gone")

    with pytest.raises(ValueError, match="gone"):
        asyncio.run(fail())
    assert taken(slots, "b") == [200]
