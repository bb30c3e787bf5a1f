#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the site and follows its links: check_site.py CMAKE BUILD

Sphinx fails on a link between pages that leads nowhere; here the pages themselves are looked at: every link and picture
is there, nothing is fetched from the network, and scripts, styles and the index of the search can be read from the disk.
"""
import re
import subprocess
import sys
from html.parser import HTMLParser
from importlib.util import find_spec
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {"img", "script", "link", "iframe", "video"}  # what a browser fetches by itself


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        self.links += [(tag, attributes[name]) for name in ("href", "src") if attributes.get(name)]


def main():
    missing = [name for name in ("sphinx", "furo", "myst_parser") if not find_spec(name)]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (Debian: python3-sphinx furo python3-myst-parser)")
        return
    cmake, build = sys.argv[1:]
    subprocess.run([cmake, "--build", build, "--target", "site"], check=True)
    html = Path(build) / "docs" / "html"
    pages = {path: Page(path) for path in html.rglob("*.html") if "_static" not in path.parts}
    faults = []
    for path, page in pages.items():
        for tag, link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if tag in LOADED and not (tag == "link" and "icon" in link):
                    faults.append(f"{path}: fetches {link}")
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                faults.append(f"{path}: {link} is not there")
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                faults.append(f"{path}: {link} has no such place")
    for script in html.glob("_static/scripts/*.js"):
        if re.search(r"^(import|export) ", script.read_text(), re.M):
            faults.append(f"{script} is a module, which browsers do not load from the disk")
    for styles in html.glob("_static/**/*.css"):
        if re.search(r"@import|url\(/", styles.read_text()):
            faults.append(f"{styles} asks for a file that is not beside it")
    index = (html / "searchindex.js").read_text()
    if not index.startswith("Search.setIndex(") or not re.search(r'\brestitut\b', index):
        faults.append("searchindex.js does not have the word restitution")
    for name in ("gallery", "keys", "tutorial", "coming_from", "limits", "core/METHOD", "tests/RESULTS"):
        if html / f"{name}.html" not in pages:
            faults.append(f"there is no page {name}")
    print("\n".join(faults) or f"{len(pages)} pages")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
