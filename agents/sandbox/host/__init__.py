"""The host's side: chooses an isolation level, starts sandboxes, distrusts what comes from them."""
