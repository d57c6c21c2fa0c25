"""A NAO over libqi."""
