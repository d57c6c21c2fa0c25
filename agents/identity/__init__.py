"""Identities of code: hashes that change with behaviour, not with names, places or words."""

from colift.agents.identity.code import Code, Root, code_hash, source_hash

__all__ = ["Code", "Root", "code_hash", "source_hash"]
