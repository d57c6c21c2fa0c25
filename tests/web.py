"""Requests of a busy machine: an answer may take a minute, not httpx's 5 s."""

from functools import partial

import httpx

get = partial(httpx.get, timeout=60.0)
post = partial(httpx.post, timeout=60.0)
