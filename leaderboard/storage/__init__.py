"""Files of a board: submissions, bundles, uploads, archives and season secrets."""
