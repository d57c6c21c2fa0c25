"""Submissions: a policy as a folder, with its manifest, its code and its weights."""
