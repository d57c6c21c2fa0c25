"""Pictures of a lift, drawn in a separate engine, so that drawing never changes the dynamics."""
