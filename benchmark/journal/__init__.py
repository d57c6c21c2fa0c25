"""The journal of a run: what is finished outlives the process, so that it can go on."""

from .journal import Journal, journal_path, open_journal

__all__ = ["Journal", "journal_path", "open_journal"]
