"""
New people
==========

The five subjects of the suites are a sample of a population, from which ``Subject.draw`` draws new
people. Policies can be tried on people for whom nothing was tuned.
"""

from colift.agents.humans import SUBJECTS, Subject
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, style_axes
from matplotlib import pyplot as plt

PAIRS = (
    ("duration", "amplitude", "duration of a stroke [s]", "height of a lift [mm]"),
    ("mass", "stiffness", "mass of the arm [kg]", "stiffness of the arm [N/m]"),
    ("haptic_delay", "visual_delay", "haptic delay [ms]", "visual delay [ms]"),
)
people = [Subject.draw(seed) for seed in range(150)]


def value(person, name):
    """Return a parameter of a person, in millimetres and milliseconds where it is small."""
    return getattr(person, name) * (1000 if name == "amplitude" or "delay" in name else 1)


# %%
# Parameters vary together as they do among the five: a stiff arm is also a heavy one. People beyond
# the limits of a healthy person are drawn again, which cuts the heights at 270 mm.

figure = plt.figure(figsize=(10, 3.5), layout="constrained")
for axes, (x, y, x_label, y_label) in zip(figure.subplots(1, 3), PAIRS, strict=True):
    drawn = [[value(each, name) for each in people] for name in (x, y)]
    axes.scatter(*drawn, s=22, color=FAINT, alpha=0.4, linewidth=0)
    for name, subject in SUBJECTS.items():
        place = value(subject, x), value(subject, y)
        axes.plot(*place, "o", color=HUMAN, markeredgecolor="white", markersize=8)
        axes.annotate(
            name, place, (5, 5), textcoords="offset points", color=INK, weight="bold", size=9
        )
    axes.set(xlabel=x_label, ylabel=y_label)
    style_axes(axes)
plt.show()
