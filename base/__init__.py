"""What every room uses: errors, names of plugins, digests, texts."""
