"""The plans of five subjects."""

from colift.agents.humans import SUBJECTS
from matplotlib import pyplot as plt
from twice import Twice

figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
for name, subject in SUBJECTS.items():
    target = Twice().plan(subject, seed=1).target
    axes.plot([frame / 100 for frame in range(len(target))], 1000 * target, label=name)
axes.set(xlabel="time [s]", ylabel="intended height [mm]")
axes.legend(ncols=5, fontsize="small", loc="upper center", bbox_to_anchor=(0.5, 1.2))
figure.savefig("plans.png", dpi=120)
