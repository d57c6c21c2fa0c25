"""The log of a service, on stderr."""

import logging
import time


def write_log(details: str = "") -> None:
    """Write warnings and errors of this process to stderr, with their times in UTC.

    ``details`` names a logger of which everything is written.
    """
    form = logging.Formatter("%(asctime)s UTC %(levelname)s %(message)s")
    form.converter = time.gmtime
    handler = logging.StreamHandler()
    handler.setFormatter(form)
    logging.basicConfig(level=logging.WARNING, handlers=[handler])
    if details:
        logging.getLogger(details).setLevel(logging.INFO)
