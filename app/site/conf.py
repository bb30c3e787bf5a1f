# SPDX-License-Identifier: GPL-3.0-or-later
# Sphinx's settings for the site. The pages come from assemble.py; they are read from the disk as well as from a server.
from pathlib import Path

project = "Talus"
author = "the authors of Talus"
release = version = "@VERSION@"
copyright = "the authors of Talus, GPL-3.0-or-later"

extensions = ["myst_parser"]
root_doc = "index"
exclude_patterns = []
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
highlight_language = "none"

html_theme = "furo"
html_title = "Talus"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_js_files = ["scripts/gumshoe-patched.js"]
html_copy_source = False
html_show_sphinx = False
# The words around a hit are fetched from its page, which browsers forbid for pages on the disk.
html_show_search_summary = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#8a4b14", "color-brand-content": "#8a4b14"},
    "dark_css_variables": {"color-brand-primary": "#e0a36a", "color-brand-content": "#e0a36a"},
}


def work_from_disk(app, error):
    """Debian's furo wants a server: it loads a script as a module, which html_js_files does instead, and normalize.css."""
    for name, line in (("scripts/furo.js", 'import Gumshoe from "./gumshoe-patched.js";'),
                       ("styles/furo.css", "@import url(/javascript/normalize.css/normalize.css);")):
        path = Path(app.outdir) / "_static" / name
        if error is None and path.is_file():
            path.write_text(path.read_text(encoding="utf-8").replace(line, ""), encoding="utf-8")


def setup(app):
    app.connect("build-finished", work_from_disk)
