"""The scatter picture of error against smoothness: one scene, drawn as PNG or SVG."""
