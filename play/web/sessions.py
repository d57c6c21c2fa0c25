"""Sessions of live lifts on disk, and the secrets by which people take their places in them."""

import hashlib
import hmac
import re
import secrets
import time
from base64 import urlsafe_b64encode
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Final, Literal, get_args

from colift.benchmark.real_lifts.session_folder import SESSION
from colift.leaderboard.storage.files import read_json, write_json

Role = Literal["host", "person", "spectator"]
"""Role that a secret allows: first person, second person, or spectator."""

ROLES: Final[tuple[Role, ...]] = get_args(Role)

FORMAT: Final = 1
"""Version of the content of :data:`.SESSION`."""

NAME: Final = re.compile(r"[0-9]{8}-[0-9a-f]{12}")
"""Pattern of a session's name: the day of its beginning (UTC), and a random number."""

SECRET_BYTES: Final = 18
"""Length of a secret; 24 characters in an address."""


@dataclass(frozen=True, kw_only=True)
class LiveSession:
    """A session: its folder, and the key from which its secrets derive."""

    name: str
    folder: Path
    key: bytes = field(repr=False)

    def secret(self, role: Role) -> str:
        """Return the secret of a role; it is the same whenever the session is read again."""
        return urlsafe_b64encode(self._derived(role)[:SECRET_BYTES]).decode()

    def role_of(self, secret: str) -> Role | None:
        """Return the role that a secret allows; None if it is not a secret of this session.

        It is compared with all of them, each time in constant time: the duration reveals nothing.
        """
        given = secret.encode(errors="replace")
        found = [role for role in ROLES if hmac.compare_digest(self.secret(role).encode(), given)]
        return found[0] if found else None

    @property
    def cue_seed(self) -> int:
        """Seed of the session's cues."""
        return int.from_bytes(self._derived("cues")[:4], "big")

    def _derived(self, purpose: str) -> bytes:
        text = f"colift live {FORMAT} {self.name} {purpose}"
        return hmac.digest(self.key, text.encode(), hashlib.sha256)


@dataclass(frozen=True)
class Sessions:
    """The sessions in a folder, a folder each; only the user of this process may read them.

    Parameters
    ----------
    folder
        The folder; it is created if missing.
    """

    folder: Path

    def make(self) -> LiveSession:
        """Create a session, with a new key."""
        now = time.time()
        name = f"{time.strftime('%Y%m%d', time.gmtime(now))}-{secrets.token_hex(6)}"
        session = LiveSession(name=name, folder=self.folder / name, key=secrets.token_bytes(32))
        self.folder.mkdir(parents=True, exist_ok=True)
        session.folder.mkdir(mode=0o700)
        content = {
            "format": FORMAT,
            "key": session.key.hex(),
            "created": round(now, 3),
            "colift": version("colift"),
        }
        write_json(session.folder / SESSION, content, mode=0o600)
        return session

    def find(self, name: str) -> LiveSession | None:
        """Return the session of that name; None if it is missing or cannot be read."""
        if not NAME.fullmatch(name):
            return None
        folder = self.folder / name
        try:
            key = bytes.fromhex(read_json(folder / SESSION)["key"])
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return LiveSession(name=name, folder=folder, key=key)
