"""The guide's build by Sphinx; `make guide` runs it on a copy of these pages (see building/build.py)."""

import os
import warnings
from importlib.metadata import metadata

os.environ["MPLBACKEND"] = "Agg"
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from bihdist import __all__ as _NAMES
from numpydoc.xref import DEFAULT_LINKS as _DEFAULT_LINKS
from pygments.lexers.special import TextLexer as _TextLexer

from app.version import version as _version
from assets.guide.building.library_pages import describe_union as _describe_union
from assets.guide.building.topics import RESULTS as _RESULTS

warnings.filterwarnings("ignore", category=DeprecationWarning)  # of what builds the pages

project = "bihdist"
author = "the authors of bihdist"
copyright = "the authors of bihdist"
version = release = _version()

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "assets.guide.building.dark_figures",
    "assets.guide.building.gallery",
    "assets.guide.building.mathml",
    "assets.guide.building.navigation",
    "assets.guide.building.shown_blocks",
]
exclude_patterns = ["_blocks", "building", "**/GALLERY_HEADER.rst"]
needs_sphinx = "8.1"
language = "en"
smartquotes = False  # `--option` outside of code, too
nitpicky = False
keep_warnings = False
html_math_renderer = "mathml"
suppress_warnings = ["misc.highlighting_failure", "config.cache"]

myst_enable_extensions = ["attrs_block", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
myst_links_external_new_tab = False

default_role = "py:obj"
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings have them, with shapes
autodoc_class_signature = "mixed"
autodoc_preserve_defaults = True
autosummary_generate = False
numpydoc_show_class_members = False  # autodoc shows them
numpydoc_xref_param_type = True
numpydoc_xref_ignore = "all"  # but our own classes, not those of other projects
numpydoc_xref_aliases = {
    **{name: name for name in _DEFAULT_LINKS},
    **{name: f"bihdist.{name}" for name in _NAMES if name[0].isupper()},
    "Source": ":doc:`Source </reference/api/sources>`",
    **{path.rpartition(".")[2]: path for paths in _RESULTS.values() for path in paths},
}
add_module_names = False
toc_object_entries_show_parents = "hide"
python_use_unqualified_type_names = True

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "gallery/auto",
    "filename_pattern": r"\.py$",
    "image_scrapers": ("assets.guide.building.gallery.saved_files",),
    "reset_modules": ("matplotlib",),
    "capture_repr": (),
    "download_all_examples": False,
    "show_signature": False,
    "show_memory": False,
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "remove_config_comments": True,
    "subsection_order": [
        f"gallery/{name}" for name in ("compare", "sources", "looks", "measure", "robustness", "share")
    ],
    "within_subsection_order": "ExampleTitleSortKey",
    "thumbnail_size": (400, 280),
    "abort_on_example_error": False,
    "only_warn_on_example_error": False,
    "log_level": {"backreference_missing": "debug"},
    "plot_gallery": True,
    "copyfile_regex": "",
    "notebook_extensions": set(),
}

templates_path = ["templates"]

html_theme = "pydata_sphinx_theme"
html_title = "bihdist guide"
html_logo = "look/logo.svg"
html_favicon = "look/logo.svg"
html_static_path = ["look"]
html_css_files = ["guide.css"]
html_js_files = ["search.js"]
html_copy_source = False
html_show_sourcelink = False
_ADDRESSES = dict(row.split(", ", 1) for row in metadata("bihdist").get_all("Project-URL") or ())
html_context = {"repository": _ADDRESSES.get("Repository", "")}
html_show_search_summary = False  # pages cannot be fetched by scripts from file://
html_use_index = False
html_theme_options = {
    "logo": {"text": "bihdist"},
    "search_bar_text": "Ask in your own words",
    "navbar_align": "left",
    "navbar_end": ["theme-switcher"],
    "navbar_persistent": ["search-button"],
    "secondary_sidebar_items": {"reference/**": ["page-toc"], "explanation/*": ["page-toc"]},
    "header_links_before_dropdown": 7,
    "show_nav_level": 1,
    "navigation_depth": 3,
    "collapse_navigation": True,
    "show_toc_level": 2,
    "footer_start": ["guide-footer"],
    "footer_end": [],
    "article_header_start": ["breadcrumbs"],
    "pygments_light_style": "a11y-light",
    "pygments_dark_style": "a11y-dark",
    "back_to_top_button": False,
}
html_sidebars = {"**": ["guide-nav"], "index": [], "search": []}
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
copybutton_exclude = ".linenos, .gp, .go"
copybutton_selector = "div:not(.printed) > div.highlight > pre"


def setup(app):
    """Show commands as they are, since numbers among their words mean nothing to a shell, and unions in words."""
    app.add_lexer("sh", _TextLexer)
    app.connect("autodoc-process-docstring", _describe_union)
