"""The manual: `make docs` builds it from these pages, the examples and the docstrings, without a network."""

import sys
from pathlib import Path

import beal

sys.path.insert(0, str(Path(__file__).parent / "_extensions"))

project = "beal"
author = "The beal developers"
version = release = beal.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc", "generated_pages", "mathml", "offline"]
exclude_patterns = ["_extensions"]
suppress_warnings = ["misc.highlighting_failure"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
html_math_renderer = "mathml"

default_role = "py:obj"  # what docstrings set in backquotes is a link
nitpicky = True

autodoc_member_order = "bysource"
autodoc_typehints = "none"
numpydoc_show_class_members = False

html_theme = "furo"
html_title = "beal"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_show_copyright = False
html_show_sourcelink = False
html_copy_source = False
