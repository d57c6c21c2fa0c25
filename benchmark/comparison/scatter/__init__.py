"""The scatter picture of error against smoothness: one scene, drawn for files or for pages."""
