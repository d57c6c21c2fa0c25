"""The configuration of the documentation site, which ``docs/build`` builds."""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS / "extensions"))

from board_look import ICON, read_variables  # noqa: E402  # It stands beside the extensions.

project = "colift"
author = "The colift developers"
project_copyright = author
version = release = version_of("colift")

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "array_types",
    "attributes",
    "catalogue",
    "commands",
    "environment",
    "fields",
    "formulas",
    "http_api",
    "metrics_table",
    "json_schema",
    "moving",
    "recorded",
    "rooms",
    "session",
]
exclude_patterns = ["extensions", "generated/gallery/*.ipynb", "generated/gallery/*.py"]
nitpicky = True
smartquotes = False  # It would make a dash of the two hyphens of an option.
nitpick_ignore_regex = [
    # The arrays behind a state of the twin have no page.
    ("py:class", r"colift\.benchmark\.twin\..*"),
    ("py:class", r"colift\.benchmark\.twin_environment\.(running|pool)\..*"),
    # What an inspection consists of.
    ("py:class", r"colift\.benchmark\.(inspection|results)\..*"),
    ("py:.*", "(?!colift).*"),  # Other projects' sites cannot be asked offline.
    ("py:(class|obj)", r"colift\.agents\.rules\.functions\..*"),  # Types of numbers and arrays.
]
# Parts of others, without pages.
nitpick_ignore = [
    ("py:func", "felt_action"),
    ("py:class", "colift.benchmark.comparison.compare.Comparison"),
    ("py:class", "colift.benchmark.comparison.ranking.RankedPolicy"),
    ("py:class", "colift.benchmark.episode.bodies.Bodies"),
    ("py:class", "colift.benchmark.world.bullet_world.BulletWorld"),
    ("py:class", "colift.benchmark.world.table.Table"),
]
templates_path = ["templates"]

myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300

autosummary_generate = True
listed = (DOCS / "reference" / "api.rst").read_text(encoding="utf-8").split()
for page in (DOCS / "generated" / "api").glob("*.rst"):
    if page.stem not in listed:
        page.unlink()  # Of a module that has been renamed: Sphinx would keep its page.
autodoc_default_options = {"members": True, "show-inheritance": True}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
napoleon_google_docstring = False

copybutton_prompt_text = "$ "
copybutton_exclude = ".linenos, .go"

sphinx_gallery_conf = {
    "examples_dirs": "../examples",
    "gallery_dirs": "generated/gallery",
    "within_subsection_order": "gallery_order.SimpleFirst",
    "filename_pattern": "/plot_",
    "abort_on_example_error": True,
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 1e9,
}

html_math_renderer = "formulas"
html_theme = "furo"
html_theme_options = {
    "light_css_variables": read_variables(0),
    "dark_css_variables": read_variables(1),
}
html_title = f"colift {version}"
html_logo = html_favicon = str(ICON)
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = [("site.js", {"defer": "defer"})]
html_search_scorer = str(DOCS / "static" / "scorer.js")
html_copy_source = False
html_show_sphinx = False
