"""The twin: the benchmark's lifts on a reduced plant, thousands at once and differentiable.

It is for learning only and never scores: no suite, bundle or board uses its figures.
"""
