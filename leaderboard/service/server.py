"""The HTTP server, as it is configured for a board."""

from typing import Final

import uvicorn
from fastapi import FastAPI

GRACE_S: Final = 3
"""What open connections have to end, when the service does [s]."""


def make_server(app: FastAPI, root: str = "") -> uvicorn.Server:
    """Return a server of an application; it logs by the loggers that there are.

    Parameters
    ----------
    app
        The application.
    root
        Path below which a proxy shows it, such as ``/board``; the proxy takes it away.
    """
    config = uvicorn.Config(
        app,
        root_path=root,
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=GRACE_S,
    )
    return uvicorn.Server(config)
