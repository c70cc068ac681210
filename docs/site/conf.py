"""The site: what tools/make_site has gathered, with the references of C++ and Python and the gallery."""

import os
import re
from pathlib import Path

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.errors import SphinxError

BUILT = Path(os.environ["CAIRN_SITE"])

project = "Cairn"
author = "The authors of Cairn"
extensions = ["myst_parser", "sphinx.ext.autodoc", "breathe", "sphinx_gallery.gen_gallery"]
html_theme = "furo"
html_title = "Cairn"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False

root_doc = "README"
include_patterns = ["*.md", "docs/*.md", "docs/**/*.md", "reference/*.rst", "gallery/*.rst"]
myst_heading_anchors = 4
# Formulas become MathML, which browsers draw themselves.
myst_enable_extensions = ["dollarmath"]
html_math_renderer = "mathml"
html_static_path = ["static"]
html_css_files = ["site.css"]

breathe_projects = {"cairn": str(BUILT / "doxygen" / "xml")}
breathe_default_project = "cairn"

autodoc_member_order = "bysource"

# The gallery begins with what is easy; an example that is not named here comes last.
GALLERY = ("bounce", "tower", "dominoes", "arch", "cradle", "linkage", "rocking", "repose", "hopper", "force_chains",
           "rollback", "friction")


class GalleryOrder:
    """Of the files of examples."""

    def __init__(self, _folder):
        pass

    def __call__(self, file):
        name = Path(file).stem[len("plot_"):]
        return GALLERY.index(name) if name in GALLERY else len(GALLERY)


sphinx_gallery_conf = {
    "within_subsection_order": GalleryOrder,
    "examples_dirs": str(BUILT / "source" / "examples_of_python"),
    "gallery_dirs": "gallery",
    "filename_pattern": r"plot_.*\.py",
    "show_memory": False,
    "min_reported_time": 1e9,
    "abort_on_example_error": True,
}

# Headers declare what others define, and pages may begin below the first level.
suppress_warnings = ["myst.header", "cpp.duplicate_declaration"]

OVERLOAD = re.compile(r"\d+\. \w+\(|\w+\(\*args, \*\*kwargs\)$|Overloaded function\.$")


def leave_out_overloads(_app, _what, _name, _object, _options, lines):
    """The lines of signatures that pybind11 writes among the texts of overloads are no prose."""
    lines[:] = [line for line in lines if not OVERLOAD.match(line)]


def add_formula(page, node, inline):
    try:
        page.body.append(latex2mathml.tex2mathml(node.astext().strip(), inline=inline))
    except SyntaxError as error:
        raise SphinxError(f"{node.source}: the formula '{node.astext()}' cannot be MathML ({error}); write it without "
                          "that command") from error
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (lambda page, node: add_formula(page, node, True), None),
                               (lambda page, node: add_formula(page, node, False), None))
    app.connect("autodoc-process-docstring", leave_out_overloads)
