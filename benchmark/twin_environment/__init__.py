"""The twin as an environment of pure functions, for one lift, or for many by ``jax.vmap``."""
