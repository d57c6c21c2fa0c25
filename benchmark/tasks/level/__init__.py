"""The task of the paper: to keep the table level while the human lifts and lowers it."""
