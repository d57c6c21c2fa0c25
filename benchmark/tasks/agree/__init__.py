"""The task to agree: two private hurdles that the whole table has to pass."""
