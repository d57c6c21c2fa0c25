"""The pages: templates, their style and scripts, and who serves or writes them."""
