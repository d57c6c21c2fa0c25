"""The body of a real person who lifts by moving a pointer."""

from typing import Final

from .subject import Subject

LIVE_SUBJECT: Final = Subject(
    name="live",
    amplitude=0.20,
    duration=2.10,
    lowering_ratio=1.05,
    submovements=(0, 0),
    motor_noise=0.0,
    tremor_amplitude=0.0,
    tremor_frequency=9.0,
    visual_delay=0.160,
    haptic_delay=0.075,
    stiffness=300.0,
    damping=16.0,
    mass=1.2,
    pull=0.0,
)
"""The arm that a real person moves, at either end and the same for everybody: stiffness, damping
and mass of S2. It has no reflexes, no motor noise and no tremor: those are the person's own. The
delays have no effect without reflexes; height and duration are those of the cues."""
