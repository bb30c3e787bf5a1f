# SPDX-License-Identifier: GPL-3.0-or-later
# Sphinx's settings for the site. The pages come from assemble.py; they are read from the disk as well as from a server.
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
html_copy_source = False
html_show_sphinx = False
# The words around a hit are fetched from its page, which browsers forbid for pages on the disk.
html_show_search_summary = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#8a4b14", "color-brand-content": "#8a4b14"},
    "dark_css_variables": {"color-brand-primary": "#e0a36a", "color-brand-content": "#e0a36a"},
}
