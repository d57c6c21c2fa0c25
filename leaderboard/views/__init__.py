"""What each page shows: frozen views, built from a board and nothing else."""
