"""The twin: the benchmark's lifts on a reduced plant, thousands at once and differentiable.

It is for learning and never scores: no suite, bundle or board takes a figure of it.
"""
