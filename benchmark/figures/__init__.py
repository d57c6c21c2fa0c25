"""The recorded figures of the documentation: printed tables and pictures, each with its command."""
