"""The practice season that is shipped with colift."""
