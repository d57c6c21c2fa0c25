"""The scatter picture of error against smoothness: one scene, as a figure for files or SVG of a page."""
