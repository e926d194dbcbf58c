# SPDX-License-Identifier: GPL-3.0-or-later
# conf.py  The site: scripts/site lays the repository's Markdown files into build/site/source and calls Sphinx with this.
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE))

project = "Macadam"
copyright = "the authors of Macadam, GPL-3.0-or-later"
version = release = subprocess.run([ROOT / "scripts" / "version"], capture_output=True, text=True, check=True).stdout.strip()
root_doc = "docs/index"
extensions = ["myst_parser", "reference", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx_copybutton",
              "contents", "repository_links", "mathml", "plain_docstrings"]
source_suffix = {".md": "markdown"}
nitpicky = False

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
myst_fence_as_directive = ["math"]
highlight_language = "none"  # for blocks without a language, which show commands and their output

breathe_projects = {"macadam": os.environ["MACADAM_DOXYGEN"]}
breathe_default_project = "macadam"
breathe_default_members = ("members",)
breathe_show_include = False
suppress_warnings = ["duplicate_declaration.cpp"]  # namespaces, which are in many files
cpp_id_attributes = ["MACADAM_HD"]

autodoc_typehints = "signature"
autodoc_member_order = "bysource"
python_use_unqualified_type_names = True
autodoc_default_options = {"members": True}

html_theme = "furo"
html_title = f"Macadam {release}"
html_static_path = [str(HERE / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {"sidebar_hide_name": False,
                      "light_css_variables": {"color-brand-primary": "#8a4b08", "color-brand-content": "#8a4b08"},
                      "dark_css_variables": {"color-brand-primary": "#e0a458", "color-brand-content": "#e0a458"}}
copybutton_exclude = ".linenos, .gp, .go"
linkcheck_ignore = [r"https?://"]  # a build needs no network; local links are Sphinx's and scripts/documents' to check
