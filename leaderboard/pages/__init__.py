"""Pages of a board: templates, formats and addresses."""
