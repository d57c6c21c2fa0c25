"""The tasks that need coordination: their people, senses and policies."""
