"""The figures of the report, one concept a file."""
