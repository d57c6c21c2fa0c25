"""Replays: a lift of the public run, drawn from its trace so that one sees how a robot lifts."""
