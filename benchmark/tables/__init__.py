"""Results as tables and text, for a terminal or a notebook."""
