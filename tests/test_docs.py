"""The documentation: examples work, links lead somewhere, imports exist."""

import ast
import importlib
import math
import re
import shutil
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
from colift.agents.actions import action_limit
from colift.agents.sandbox.host.policy import close_sandboxes
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import open_submission, read_submission
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.results.citation import bibtex

ROOT = Path(__file__).parents[1]
OBSERVATION = np.array([0.12, 0.1, 0.105, 0.11, 3.0])


def python_blocks(page):
    """Return the blocks of Python in a page, in order."""
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.DOTALL | re.MULTILINE)


def test_the_first_policy_is_the_same_in_readme_and_template(tmp_path):
    (source,) = (block for block in python_blocks("README.md") if "class Policy" in block)
    shown = {}
    exec(source, shown)
    write_template(tmp_path / "mine")
    template = read_submission(tmp_path / "mine").trusted().make()
    template.reset(0)
    action = template.act(OBSERVATION)
    assert action == pytest.approx(1.8 * (OBSERVATION[0] - OBSERVATION[2]))
    assert shown["Policy"]().act(OBSERVATION) == action


@pytest.mark.parametrize(
    "page", ["README.md", "docs/guides/submissions.md", "agents/submissions/template/policy.py"]
)
def test_the_largest_action_is_where_a_submitter_reads(page):
    assert f"{action_limit(CONTROL_PERIOD):.2f} m" in (ROOT / page).read_text()


def test_the_recipe_for_a_trained_net_plays_what_the_net_says(tmp_path):
    """The weights are of a net that is known: two linear layers, here evaluated by hand."""
    write_template(tmp_path / "mine")
    policy = ROOT / "examples" / "networks" / "numpy_policy.py"
    shutil.copy(policy, tmp_path / "mine" / "policy.py")
    rng = np.random.default_rng(1)
    w0, b0 = rng.normal(0.0, 1.0, (8, 4)), rng.normal(0.0, 1.0, 8)
    w1, b1 = rng.normal(0.0, 0.01, (1, 8)), rng.normal(0.0, 0.01, 1)
    np.savez(tmp_path / "mine" / "weights.npz", w0=w0, w1=w1, b0=b0, b1=b1)
    with open_submission(tmp_path / "mine").sandboxed().agent() as policy:
        policy.reset(0)
        policy.act(OBSERVATION)
        (action,) = policy.act(OBSERVATION)
    close_sandboxes()
    inputs = [OBSERVATION[2], 0.0, OBSERVATION[0], OBSERVATION[0]]
    hidden = [
        math.tanh(sum(w * x for w, x in zip(row, inputs, strict=True)) + b)
        for row, b in zip(w0, b0, strict=True)
    ]
    wanted = sum(w * h for w, h in zip(w1[0], hidden, strict=True)) + b1[0]
    assert action == pytest.approx(wanted, rel=1e-9)


def pages():
    """Return the documentation, each page relative to the repository."""
    names = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"]
    found = [path for path in ROOT.glob("docs/**/*.md") if "generated" not in path.parts]
    return [*names, *sorted(str(path.relative_to(ROOT)) for path in found)]


def anchors(path):
    """Return the anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.+)$", path.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", pages())
def test_links_lead_to_a_file_and_to_a_heading_in_it(page):
    links = re.findall(r"\]\((?!https?:)([^)#]*)(?:#([^)]+))?\)", (ROOT / page).read_text())
    for path, anchor in links:
        target = (ROOT / page).parent / path if path else ROOT / page
        assert target.exists(), f"{page} links to {path}"
        assert not anchor or anchor in anchors(target), f"{page} links to {path}#{anchor}"


@pytest.mark.parametrize("page", pages())
def test_imports_in_the_documentation_exist(page):
    for source in python_blocks(page):
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("colift"):
                module = importlib.import_module(node.module)
                assert all(hasattr(module, name.name) for name in node.names), ast.unparse(node)


def test_a_glossary_entry_stands_once():
    terms = re.findall(
        r"^- \*\*(.+?)\*\*: ", (ROOT / "docs/reference/glossary.md").read_text(), re.MULTILINE
    )
    assert len(terms) >= 35
    assert len(terms) == len(set(terms))


@pytest.mark.parametrize("page", pages())
def test_paths_in_the_documentation_exist(page):
    found = re.findall(
        r"`((?:agents|base|benchmark|cli|leaderboard|play|robots|src|tests|examples|docs)/[\w/.-]+)`",
        (ROOT / page).read_text(),
    )
    assert [path for path in found if not (ROOT / path).exists()] == []


def test_what_to_cite_is_this_version():
    assert f"version: {version('colift')}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"```bibtex\n{bibtex()}```" in (ROOT / "docs/background/cite.md").read_text()
