"""A policy on a physical robot: ports, their back-ends, safety, and the real-time loop."""
