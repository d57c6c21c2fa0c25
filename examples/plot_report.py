"""
From a score to its reasons, and into a paper
=============================================

A policy is scored, its errors are explained, and it is compared with others on the same lifts. Each
result shows itself in a notebook, light or dark, and writes the files that a paper needs.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import colift

# %%
# An evaluation has the error of each lift, beside that of two people on the same lift.

evaluation = colift.evaluate("blend")
evaluation

# %%
# Its reasons: the worst lifts and moments, strengths and weaknesses, beside two people. For a
# result bundle of ``colift run --out``, ``colift.load(FOLDER)`` returns the evaluation.

colift.inspect(evaluation, worst=1)

# %%
# A comparison takes policies by name, objects, evaluations and the folders of result bundles. What
# has been played is not simulated again.

comparison = colift.compare(evaluation, "blend,forgetting=0.95", "anticipate")
comparison

# %%
# A picture of one lift: three moments, and the heights of both ends of the table.

lift = colift.render("blend", behaviour="pause", seed=2)
lift

# %%
# In a column of print a figure is 3.5 inches wide, on a page 7; its letters have 8 points, and stay
# text in SVG and PDF. The comparison also writes its table for LaTeX, and what to cite.

with TemporaryDirectory() as folder:
    lift.save(f"{folder}/lift.pdf", "column")
    comparison.save(folder, "page")
    print(*sorted(path.name for path in Path(folder).iterdir()), sep="\n")
print(comparison.bibtex)
# sphinx_gallery_thumbnail_path = "figures/compare.png"
