"""Topics of the paper: each with its measurements, its claims and its exhibits."""
