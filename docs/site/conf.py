"""Configuration of Sphinx; ``docs.site`` gives it pages laid out like the repository."""

from __future__ import annotations

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx

import rotordyn

project = "rotordyn"
author = "rotordyn contributors"
project_copyright = author
release = version = rotordyn.__version__

root_doc = "index"
extensions = [
    "sphinx.ext.autodoc",
    "myst_parser",
    "docs.site.links",
    "docs.site.docstrings",
    "docs.site.mathml",
    "docs.site.navigation",
]

# Documents: formulas between dollars, headings that can be linked as on a code host.
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4

# Types in signatures without a link: those of other libraries, short names of arrays, and types
# that the interface mentions without being part of it.
nitpicky = True
nitpick_ignore_regex = [
    (
        "py:class",
        r"Figure|Pictures|Flow",
    ),  # of matplotlib; of a package that is no part of the interface
    (r"py:.*", r"(numpy|np|xarray|xr|pathlib|collections|typing|rotordyn|bearings)(\..*)?"),
    (r"py:.*", r"(Array|ArrayLike|NDArray|Complex|Flags|Words|Mapping|Sequence|Path|Fits)"),
]
autodoc_type_aliases = {n: n for n in ("Array", "Complex", "Flags", "Words", "Fits")}
autodoc_member_order = "bysource"
autodoc_class_signature = "mixed"
python_maximum_signature_line_length = 88
python_use_unqualified_type_names = True
add_module_names = False


def setup(app: Sphinx) -> None:
    """Tables of measured values are in blocks ``csv``, for which Pygments has no lexer."""
    app.add_lexer("csv", TextLexer)


html_theme = "furo"
html_title = f"rotordyn {release}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}
