"""The board on the web: a JSON interface, uploads, and the pages."""
