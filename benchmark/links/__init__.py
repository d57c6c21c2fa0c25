"""Links: the delays and losses of messages, in one direction."""
