"""Identities of code: hashes that change with behaviour, not with names, places or words."""

from colift.base.identity.code import Code, Root, code_hash, source_hash
from colift.base.identity.modules import Module, Reference

__all__ = ["Code", "Module", "Reference", "Root", "code_hash", "source_hash"]
