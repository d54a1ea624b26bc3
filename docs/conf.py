"""How the site is built: `make docs`. Everything a page needs lies beside it; nothing is fetched, now or later."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from pathlib import Path

from singletrack.version import __version__

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))
# For the notebooks, too: the program on their path, and no threads for small matrices.
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
os.environ["OMP_NUM_THREADS"] = "1"
os.environ["TTY_COMPATIBLE"] = "0"  # no bars of progress

project = "singletrack"
author = "the singletrack developers"
copyright = "the singletrack developers, BSD-3-Clause"  # noqa: A001  # the word is Sphinx'
version = release = __version__

extensions = [
    "generated",
    "references",
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = [
    "_build",
    "_ext",
    "gallery",
    "**/.ipynb_checkpoints",
    "auto_gallery/*.ipynb",
    "sg_execution_times.rst",
    "auto_gallery/sg_execution_times.rst",
]
highlight_language = "none"
# Every function, method, module and constant that is named exists. Words of types ("sequence of str") are not names.
nitpicky = True
nitpick_ignore_regex = [(r"py:(class|obj|exc)", r".*")]
suppress_warnings = [
    "config.cache",  # the gallery's order is a class, which is no matter for the cache
    "ref.python",  # `name` is an attribute of several records
]

# Pages and notebooks.
myst_enable_extensions = ["amsmath", "attrs_block", "attrs_inline", "colon_fence", "deflist", "dollarmath", "fieldlist"]
myst_heading_anchors = 4
nb_execution_mode = "cache"  # a page is executed again when its code has changed
nb_execution_cache_path = str(HERE / "_build" / "executed")
nb_execution_in_temp = True
nb_execution_show_tb = True  # a cell that fails is a warning, and warnings are errors
nb_execution_timeout = 120
nb_merge_streams = True

copybutton_prompt_text = "!"  # of commands in notebooks

# Programs and their documentation.
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
napoleon_use_ivar = True
napoleon_use_rtype = False
napoleon_preprocess_types = False

# The gallery: scripts of `gallery`, run when they have changed.
sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "auto_gallery",
    "filename_pattern": r"\.py$",
    "image_scrapers": ("matplotlib", "returned_figures"),
    "capture_repr": (),  # scripts print what they have to say
    "within_subsection_order": "FileNameSortKey",
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_signature": False,
    "min_reported_time": 5,
    "abort_on_example_error": True,
    "plot_gallery": "True",
}

# What a reader sees.
html_theme = "pydata_sphinx_theme"
html_title = "singletrack"
html_copy_source = False
html_show_sourcelink = False
html_static_path = ["_static", str(HERE.parent / "src" / "singletrack" / "webpage" / "static" / "page.html")]
html_context = {"default_mode": "auto"}
html_css_files = ["singletrack.css"]
html_theme_options = {
    "logo": {"text": "singletrack"},
    "navbar_end": ["theme-switcher"],
    "navbar_align": "left",
    "header_links_before_dropdown": 8,
    "show_prev_next": True,
    "show_toc_level": 2,
    "footer_start": ["copyright"],
    "footer_end": [],
    # The pages of the gallery give the room beside them to pictures and code.
    "secondary_sidebar_items": {
        "**": ["page-toc"],
        **{f"auto_gallery/{path.stem}": [] for path in HERE.glob("gallery/*.py")},
    },
}

# One script that has its letters within: nothing else is loaded for formulas.
_mathjax = find_spec("sphinx-mathjax-offline")
if _mathjax is None or _mathjax.origin is None:
    raise ModuleNotFoundError("sphinx-mathjax-offline: run `make docs`, which installs it")
html_static_path.append(str(Path(_mathjax.origin).parent / "static" / "mathjax" / "tex-svg.js"))
mathjax_path = "tex-svg.js"
mathjax3_config = {"options": {"enableMenu": False}, "svg": {"fontCache": "global"}}
