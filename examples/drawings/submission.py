"""The way of a submission to a row of a board."""

from colift.benchmark.rendering.style import AIM, FAINT, HUMAN, INK, ROBOT, SKY
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.audit import SAMPLES
from sheet import arrow, box, sheet, write

LIFTS = make_suite("standard-v1").size
STAGES = (
    ("submission", "a folder with a policy, or a network", INK),
    ("check", "interface, determinism, a first score", INK),
    ("public run", f"{LIFTS} lifts that everybody knows", HUMAN),
    ("audit", f"{SAMPLES} lifts again, loaded anew: equal to the bit", HUMAN),
    ("verification", "the bundle, simulated again from its actions", HUMAN),
    ("hidden run", f"{LIFTS} lifts with people whom nobody knows; audited", ROBOT),
    ("row", "ranked by the hidden lifts", AIM),
)
STEP, HEIGHT, WIDE = 14.0, 10.0, 66.0

figure, axes = sheet(100, STEP * len(STAGES) + 2)
top = STEP * len(STAGES) - HEIGHT + 1
for place, (name, words, colour) in enumerate(STAGES):
    y = top - STEP * place
    box(axes, (2, y), (WIDE, HEIGHT), name, words, edge=colour, ground=SKY if place == 5 else "w")
    if place:
        arrow(axes, (2 + WIDE / 2, y + STEP), (2 + WIDE / 2, y + HEIGHT))
NOTES = (
    (1, "refused, with\nthe reason", FAINT),
    (3, "published: scores,\nbundle, replays", HUMAN),
    (5, "secret until the\nseason ends:\npeople and seeds", ROBOT),
)
for place, words, colour in NOTES:
    y = top - STEP * place + HEIGHT / 2
    axes.text(4 + WIDE + 3, y, words, color=colour, va="center", size=8)
for first, last, colour in ((2, 4, HUMAN), (5, 5, ROBOT)):
    ends = [top - STEP * first + HEIGHT, top - STEP * last]
    axes.plot([4 + WIDE, 4 + WIDE], ends, color=colour, linewidth=2)
arrow(axes, (2 + WIDE, top - STEP + HEIGHT / 2), (6 + WIDE, top - STEP + HEIGHT / 2))
write(figure)
