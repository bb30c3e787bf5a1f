#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gathers the pages of the site, for Sphinx to build.

    app/site/assemble.py TALUS MADE SOURCE

The READMEs of the tree are pages as they are, at their own places, so that links between them hold. What the program
says of itself (`talus keys`, `--help`) and what gallery.py and tutorial.py left in the folder MADE become further pages.
The rest is in pages/, in which lines `<<< WHAT` stand for a part of a README, a file or what a command prints.
Everything goes to SOURCE, which is made anew.
"""
import html
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE.parent))
import man_pages  # noqa: E402  the reader of the program's help

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)#\s:]+)(#[^)]*)?\)")
LANGUAGES = {".toml": "toml", ".py": "python", ".txt": "cmake", ".cpp": "cpp"}
TOP = "At the top of the file"
NOT_PAGES = {"build", "out", "node_modules"}


def slug(heading):
    """As GitHub and MyST make it."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def section(path, name):
    """The body of a section of a Markdown file, without its heading."""
    lines, begin, depth = path.read_text().split("\n"), None, 0
    for number, line in enumerate(lines):
        heading = re.match(r"(#+) (.*)", line)
        if begin is None and heading and slug(heading[2]) == name:
            begin, depth = number + 1, len(heading[1])
        elif begin is not None and heading and len(heading[1]) <= depth:
            return "\n".join(lines[begin:number]).strip()
    if begin is None:
        sys.exit(f"assemble.py: {path} has no section '{name}'")
    return "\n".join(lines[begin:]).strip()


class Site:
    def __init__(self, talus, made, source):
        self.talus, self.made, self.source = talus, made, source
        self.pages = {path.relative_to(ROOT) for path in ROOT.rglob("*.md")
                      if not NOT_PAGES & set(path.relative_to(ROOT).parts[:-1])
                      and not path.is_relative_to(HERE) and not path.relative_to(ROOT).parts[0].startswith("build")}

    def write(self, page, text):
        target = self.source / page
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)

    def place(self, page):
        """Where a page of the tree stands in the site; README.md is its first."""
        return Path("index.md") if page == Path("README.md") else page

    def linked(self, text, page, at):
        """The text of a page of the tree, to stand at a place of the site: its links go to pages, or to copies of
        files; those to folders become plain words."""
        def replace(link):
            image, words, target, anchor = link[1], link[2], link[3], link[4] or ""
            file = Path(os.path.normpath(page.parent / target))
            if file in self.pages:
                file = self.place(file)
            elif file.is_relative_to("app/site/pages"):
                file = Path(file.name)
            elif (ROOT / file).is_file():
                (self.source / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / file, self.source / file)
            elif (ROOT / file).is_dir():
                return words
            else:
                sys.exit(f"assemble.py: {page} links to {target}, which is not there")
            return f"{image}[{words}]({os.path.relpath(file, at.parent)}{anchor})"
        return LINK.sub(replace, text)

    def tree_pages(self):
        for page in self.pages:
            at = self.place(page)
            self.write(at, self.linked((ROOT / page).read_text(), page, at))
        index = self.source / "index.md"
        index.write_text(index.read_text() + "\n" + (HERE / "contents.md").read_text())

    def own_pages(self):
        shutil.copytree(HERE / "tutorial", self.source / "tutorial")
        for path in sorted((HERE / "pages").glob("*.md")):
            at = Path(path.name)
            text = re.sub(r"^<<< (.*[/$].*)$", lambda line, at=at: self.included(line[1], at), path.read_text(),
                          flags=re.M)
            self.write(at, self.with_pictures(re.sub(r"^```sh run$", "```sh", text, flags=re.M)))

    def included(self, what, at):
        """What stands for a line `<<< WHAT` of a page: what a command prints (`$ talus …`, in the folder of the
        tutorial), a section of a README (FILE#heading), or a file."""
        if what.startswith("$ talus "):
            printed = subprocess.run([self.talus, *shlex.split(what)[2:]], cwd=HERE / "tutorial", check=True,
                                     capture_output=True, text=True).stdout
            return f"```\n{printed}```"
        file, _, name = what.partition("#")
        if name:
            return self.linked(section(ROOT / file, name), Path(file), at)
        return f"`{Path(file).name}`\n\n```{LANGUAGES[Path(file).suffix]}\n{(ROOT / file).read_text()}```"

    def with_pictures(self, text):
        """Pictures that a script makes are shown where they are made, and else named."""
        def picture(link):
            file = self.made / link[2]
            if not file.exists():
                return f"*({link[1]}: not made yet)*"
            (self.source / link[2]).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, self.source / link[2])
            return link[0]
        return re.sub(r"!\[([^\]]*)\]\(((?:tutorial|gallery)/[^)]*)\)", picture, text)

    def keys_page(self):
        tables, known = [], {}
        for table in man_pages.ask(self.talus, "keys").strip().split("\n\n"):
            name, _, body = table.partition("\n")
            tables.append(f"\n## {TOP if name == 'a scene' else name}\n")
            if body in known:
                tables.append(f"The keys of [{known[body]}](#{slug(known[body])}).\n")
                continue
            known[body] = name
            tables += ["| key | is | default | meaning |", "| --- | --- | --- | --- |"]
            tables += [f"| `{key}` | {rule} | {default} | {meaning} |" for key, rule, default, meaning in keys_of(body)]
        self.write(Path("keys.md"), (HERE / "pages" / "keys.md").read_text().replace("<<< keys", "\n".join(tables)))

    def commands_page(self):
        verbs = man_pages.read_help(man_pages.ask(self.talus, "--help")).lists["Subcommands"]
        text = (HERE / "pages" / "commands.md").read_text()
        for verb, _ in verbs:
            told = man_pages.read_help(man_pages.ask(self.talus, verb, "--help"))
            rows = [(man_pages.tidy(name), meaning) for kind in ("Positionals", "Options")
                    for name, meaning in told.lists.get(kind, []) if name != "-h,--help"]
            text += f"\n## talus {verb}\n\n{told.purpose}.\n\n```sh\n{told.usage}\n```\n\n"
            if rows:
                text += "| argument | meaning |\n| --- | --- |\n"
                text += "".join(f"| `{name}` | {cell(meaning)} |\n" for name, meaning in rows)
            footer = [re.sub(r"^Example: (.*)", r"```sh\n\1\n```", line) for line in told.footer]
            text += "\n" + "\n\n".join(footer) + "\n"
        self.write(Path("commands.md"), text)

    def gallery(self):
        """A card and a page for each scene."""
        static = self.source / "_static"
        (static / "gallery").mkdir(parents=True)
        shutil.copy(HERE / "site.css", static / "site.css")
        cards, contents = [], []
        for entry in tomllib.loads((HERE / "gallery.toml").read_text())["run"]:
            name = entry["scene"]
            told = self.made / "gallery" / f"{name}.json"
            run = json.loads(told.read_text()) if told.exists() else None
            files = [file for ending in ("png", "html") if (file := told.with_suffix(f".{ending}")).exists()]
            for file in files:
                shutil.copy(file, static / "gallery" / file.name)
            scene = Scene(name)
            cards.append(scene.card(run))
            contents.append(f"{name} <scenes/{name}>")
            self.write(Path("scenes") / f"{name}.md", scene.page(run, {file.suffix for file in files}))
        text = (HERE / "pages" / "gallery.md").read_text()
        text = text.replace("<<< gallery", "<div class='gallery'>\n" + "\n".join(cards) + "\n</div>")
        self.write(Path("gallery.md"), text.replace("<<< scenes", "\n".join(contents)))


def cell(text):
    return text.replace("|", "\\|")


def keys_of(body):
    """Rows of a table of `talus keys`: key, what it is, its default, what it means and with what it goes."""
    rows = []
    for line in body.split("\n"):
        if line.startswith("    "):
            rows[-1][3] = cell(line.strip())
            continue
        key, _, rule = line.strip().partition(" ")
        is_what, default, only = [], "", ""
        for part in rule.strip().split("; "):
            if part.startswith("default "):
                default = f"`{part.removeprefix('default ')}`"
            elif part in ("required", "may be left out"):
                default = "**required**" if part == "required" else "–"
            elif part.startswith("with "):
                only = f"; {part}"
            else:
                is_what.append(part)
        rows.append([key, cell("; ".join(is_what) + only), default, ""])
    return rows


class Scene:
    """A supplied scene, and what there is to tell of it."""

    def __init__(self, name):
        self.name = name
        self.file = ROOT / "scenarios" / f"{name}.toml"
        self.text = self.file.read_text()
        # the digits of 10 000 stay in one line
        self.title = re.sub(r"(?<=\d) (?=\d{3}\b)", "\u00a0", tomllib.loads(self.text)["title"])

    def comment(self):
        """What to expect: the comments that the file begins with, as Markdown."""
        lines = []
        for line in self.text.split("\n"):
            if not line.startswith("#"):
                break
            lines.append(line.removeprefix("#").removeprefix(" "))
        text = re.sub(r"^  (--set .*)", r"\n```sh\n\1\n```\n", "\n".join(lines), flags=re.M)
        return re.sub(r"(?<!\n)\nExpect", "\n\nExpect", text)

    def figures(self, run):
        summary = run["summary"]
        return (f"{summary['ledger']['inserted']} spheres, {summary['time']['simulated']:.3g} s in "
                f"{summary['timing']['cpu']:.0f} CPU seconds")

    def card(self, run):
        picture = (f"<img src='_static/gallery/{self.name}.png' alt='{html.escape(self.title)}' loading='lazy'>" if run
                   else "<div class='nothing'>no picture made yet</div>")
        figures = f"<div class='figures'>{self.figures(run)}</div>" if run else ""
        return (f"<a href='scenes/{self.name}.html'>{picture}<div class='words'><div class='title'>"
                f"{html.escape(self.title)}</div><div>{self.name}</div>{figures}</div></a>")

    def page(self, run, made):
        parts = [f"# {self.title}\n"]
        if ".png" in made:
            parts.append(f"![{self.title}](../_static/gallery/{self.name}.png)\n")
        if ".html" in made:
            parts.append(f"<p><a href='../_static/gallery/{self.name}.html'><b>Play this run</b></a></p>\n")
        parts.append(f"## What to expect\n\n{self.comment()}\n")
        parts.append(f"## To run it\n\n```sh\ntalus run {self.name}\ntalus new mine --from {self.name}     "
                     "# a copy of your own\n```\n")
        if run:
            at = f" at commit {run['commit']}" if run["commit"] else ""
            parts.append(f"The picture is from `{run['command']}`{at}: {self.figures(run)}.\n")
        parts.append(f"## The scene\n\n```toml\n{self.text}```\n")
        return "\n".join(parts)


def main():
    if len(sys.argv) != 4:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    site = Site(os.path.abspath(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]))
    shutil.rmtree(site.source, ignore_errors=True)
    site.source.mkdir(parents=True)
    version = man_pages.ask(site.talus, "--version").split()[1]
    site.write(Path("conf.py"), (HERE / "conf.py").read_text().replace("@VERSION@", version))
    site.tree_pages()
    site.own_pages()
    site.keys_page()
    site.commands_page()
    site.gallery()


if __name__ == "__main__":
    main()
