"""Client of a board on the web."""

import json
import tempfile
import time
import urllib.error
import urllib.request
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any, Final

from colift.base.errors import InputError
from colift.leaderboard.storage.archive import pack_archive

API: Final = "/api/v1"

TIMEOUT_S: Final = 120.0
"""Longest time that the board may take to answer [s]."""

PATIENCE: Final = 30
"""Number of attempts while the board is overloaded."""

BUSY: Final = (429, 502, 503, 504)
"""Status codes of an overloaded board, or of a server before it."""


QUOTA: Final = 429
"""Status code for a submitter over quota: not worth waiting for."""


class _NoRedirect(urllib.request.HTTPRedirectHandler):
    """A handler that follows no redirect: the token is for this board alone."""

    def redirect_request(self, *arguments: Any) -> None:
        """Return no request, so that the redirect is not followed."""


@dataclass(frozen=True)
class RemoteBoard:
    """A board behind a URL."""

    url: str
    """Such as ``https://board.example.org``."""
    token: str = field(default="", repr=False)

    def submitter(self) -> str:
        """Return the token's owner; :class:`.InputError` as :meth:`submit`."""
        answer = self._patiently("/me", self._identity)
        if not isinstance(answer, dict) or "submitter" not in answer:
            raise InputError(
                f"{self.url} is not a board of colift: it does not name the token's owner"
            )
        return str(answer["submitter"])

    def submit(self, folder: Path) -> dict[str, Any]:
        """Submit a folder; return its job as JSON of the API.

        Parameters
        ----------
        folder
            The submission's files, and nothing else.

        Raises
        ------
        InputError
            If the board does not answer or refuses it; the message is the board's.
        """
        with tempfile.TemporaryFile() as file:
            pack_archive(folder, file)
            size = file.tell()
            headers = {
                **self._identity,
                "Content-Type": "application/zip",
                "Content-Length": str(size),
            }
            answer: dict[str, Any] = self._patiently("/submissions", headers, file)
        return answer

    def job(self, id: str) -> dict[str, Any]:  # noqa: A002
        """Return the progress of a job; :class:`.InputError` as :meth:`submit`."""
        answer: dict[str, Any] = self._patiently(f"/jobs/{id}")
        return answer

    def standings(self, season: str) -> list[dict[str, Any]]:
        """Return a season's table, best first; :class:`.InputError` as :meth:`submit`."""
        answer: list[dict[str, Any]] = self._patiently(f"/standings?season={season}")
        return answer

    def suite(self) -> str:
        """Return the name of the current season's suite; :class:`.InputError` as :meth:`submit`."""
        seasons: list[dict[str, Any]] = self._patiently("/seasons")
        return next(str(each["suite"]) for each in seasons if each["current"])

    @property
    def _identity(self) -> dict[str, str]:
        return {"Authorization": f"Bearer {self.token}"}

    def _patiently(
        self, path: str, headers: dict[str, str] | None = None, body: IO[bytes] | None = None
    ) -> Any:
        """Return an answer; if the board is overloaded, wait and ask again."""
        for _ in range(PATIENCE):
            try:
                if body is not None:
                    body.seek(0)
                return self._ask(path, body, headers)
            except _BusyError as busy:
                if body is not None and busy.code == QUOTA:
                    raise
                time.sleep(busy.seconds)
                last = busy
        raise last

    def _ask(
        self, path: str, body: IO[bytes] | None = None, headers: dict[str, str] | None = None
    ) -> Any:
        address = self.url.rstrip("/") + API + path
        request = urllib.request.Request(address, data=body, headers=headers or {})
        opener = urllib.request.build_opener(_NoRedirect)
        try:
            with opener.open(request, timeout=TIMEOUT_S) as answer:
                return json.load(answer)
        except urllib.error.HTTPError as error:
            raise _refusal(self.url, error) from error
        except (OSError, urllib.error.URLError) as error:
            reason = getattr(error, "reason", error)
            raise InputError(f"board {self.url} does not answer: {reason}") from error
        except ValueError as error:
            raise InputError(f"{address} is not a board of colift: {error}") from error


class _BusyError(InputError):
    """The board is overloaded."""

    def __init__(self, message: str, code: int, seconds: float) -> None:
        super().__init__(message)
        self.code, self.seconds = code, seconds


def _refusal(url: str, error: urllib.error.HTTPError) -> InputError:
    """Return the error for a request that the board refused."""
    with error:
        body = error.read(100_000)
        wait = error.headers.get("Retry-After", "")
    try:
        message = str(json.loads(body)["error"])
    except (ValueError, KeyError, TypeError):
        message = f"it answers {error.code} {error.reason}; is it a board of colift?"
    message = f"board {url}: {message}"
    if error.code in BUSY:
        return _BusyError(message, error.code, min(float(wait), 60.0) if wait.isdecimal() else 2.0)
    return InputError(message)
