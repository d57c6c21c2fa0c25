"""What to cite: colift in its version, with a suite, and the paper that it generalises."""

from importlib.metadata import version
from typing import Final

from colift.base.tex import tex
from colift.benchmark.suites.suite import Suite

THE_PAPER: Final = """\
@inproceedings{thobbi2011using,
  title     = {Using Human Motion Estimation for Human-Robot Cooperative Manipulation},
  author    = {Thobbi, Anand and Gu, Ye and Sheng, Weihua},
  booktitle = {IEEE/RSJ International Conference on Intelligent Robots and Systems (IROS)},
  year      = {2011}
}
"""


def bibtex(suite: Suite | None = None) -> str:
    """Return the entries of BibTeX for results on a suite, or for colift alone.

    Version and suite are in ``note``, which every style prints.
    """
    on = "" if suite is None else f", suite {tex(suite.name)} with digest {suite.digest}"
    return f"""\
@misc{{colift,
  title  = {{colift: a benchmark for human-robot cooperative lifting}},
  author = {{{{The colift developers}}}},
  note   = {{Version {version("colift")}{on}}}
}}
{THE_PAPER}"""
