"""Settings of the documentation: ``python -m sphinx -W --keep-going -b html docs build/docs``."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "figures"))

import pyrod  # noqa: E402

project = "pyrod"
author = "The pyrod developers"
copyright = author
version = release = pyrod.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
]
nitpicky = True
nitpick_ignore = [("py:obj", "scipy.sparse.csc_array")]

# Pages: the same files are read on GitHub, so formulas are text and anchors are GitHub's.
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4
exclude_patterns = ["gallery/*.md5", "gallery/*.py", "gallery/*.ipynb"]

# Reference: shapes and units are in the docstrings, so signatures show names and defaults only.
default_role = "py:obj"
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_class_signature = "mixed"
napoleon_google_docstring = False
napoleon_use_param = False
napoleon_use_rtype = False
napoleon_attr_annotations = False

html_theme = "pydata_sphinx_theme"
html_title = f"pyrod {release}"
html_show_sourcelink = False
html_copy_source = False
html_static_path = ["_static"]
html_css_files = ["pyrod.css"]
html_theme_options = {
    "header_links_before_dropdown": 7,
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "show_prev_next": True,
    "footer_start": ["copyright"],
    "footer_end": [],
}

sphinx_gallery_conf = {
    "examples_dirs": "../examples/plot",
    "gallery_dirs": "gallery",
    "filename_pattern": "plot_",
    "download_all_examples": False,
    "show_memory": False,
    "write_computation_times": False,
    "min_reported_time": 1e9,
    "reset_modules": (),  # the style of the pictures is set once
    "abort_on_example_error": True,
    "within_subsection_order": "FileNameSortKey",
    "capture_repr": (),
}
