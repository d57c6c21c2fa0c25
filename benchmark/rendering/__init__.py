"""Pictures of a lift. Drawn in an engine of their own: looking never changes the dynamics."""
