#!/usr/bin/env python3
"""Builds the site of the documentation: ``tools/docs_site.py [--output DIR]``, ``make docs``.

MkDocs reads a copy in build/docs: the pages of docs/, of the cogs, and those beside README.md. A
link to another file of the repository leads to a page that shows the file; docs/api.md gets the
docstrings of the public names. The output has a folder for each version and a list of them.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))  # A program finds only the modules of its own folder.

from up import public  # noqa: E402
from up.version import VERSION  # noqa: E402

STAGE = ROOT / "build" / "docs"
SERVED = ROOT / "ground/up_ground/web/static/docs"
"""The copy of the ground station's page, which a release has, too."""
API = "docs/api.md"
BESIDE = {
    "README.md": "index.md",
    "docs/README.md": "contents.md",
    "CHANGELOG.md": "project/changes.md",
    "CONTRIBUTING.md": "project/contributing.md",
    # Another name than docs/security.md where a file system ignores the case.
    "SECURITY.md": "project/vulnerabilities.md",
    "arduino/bench/README.md": "arduino/bench/README.md",
    "config/blackbox/README.md": "config/blackbox/README.md",
}
"""Pages with another place in the site than below docs/, by their path in the repository."""
_FENCE = re.compile(r"(^```.*?^```$)", re.DOTALL | re.MULTILINE)
_COMMENT = re.compile(r"^<!--.*?-->$", re.DOTALL | re.MULTILINE)
_LINK = re.compile(r"(\[[^\]]*\])\(([^)\s]+)\)")
_LANGUAGES = {".py": "python", ".yml": "yaml", ".cpp": "cpp", ".js": "js", ".md": "markdown"}


class SiteError(Exception):
    """A page that cannot be part of the site; the text names page and link."""


def pages() -> dict[str, str]:
    """Return the place in the site of each page, by its path in the repository."""
    found = [*(ROOT / "docs").rglob("*.md"), *(ROOT / "cogs").glob("*/*.md")]
    names = sorted(each.relative_to(ROOT).as_posix() for each in found)
    return {name: name.removeprefix("docs/") for name in names} | BESIDE


class Stage:
    """The copy of the pages that MkDocs reads."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._places = pages()
        self._files: set[str] = set()

    def write(self) -> None:
        """Write every page, and the files to which they link; raises SiteError."""
        shutil.rmtree(self._folder, ignore_errors=True)
        for name, place in self._places.items():
            text = (ROOT / name).read_text(encoding="utf-8")
            self._write(place, self._for_site(text, name) + (_reference() if name == API else ""))
        for name in self._files:
            self._write(_file_page(name), _shown(name))

    def _write(self, place: str, text: str) -> None:
        path = self._folder / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def _copy(self, name: str, place: str) -> None:
        (self._folder / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, self._folder / place)

    def _for_site(self, text: str, name: str) -> str:
        """Return a page without its comments for tests, and with the site's links."""
        parts = _FENCE.split(text)
        for number in range(0, len(parts), 2):
            part = _COMMENT.sub("", parts[number])
            parts[number] = _LINK.sub(
                lambda found: f"{found[1]}({self.link(found[2], name)})", part
            )
        return "".join(parts)

    def link(self, link: str, page: str) -> str:
        """Return a link of a page for its place in the site; raises SiteError."""
        path, mark, anchor = link.partition("#")
        if not path or ":" in path:
            return link
        target = os.path.normpath(PurePosixPath(page).parent / path)
        if PurePosixPath(target).suffix in (".png", ".svg"):
            place = target.removeprefix("docs/")
            self._copy(target, place)
        elif target in self._places:
            place = self._places[target]
        elif (ROOT / target).is_file():
            self._files.add(target)
            place = _file_page(target)
        else:
            raise SiteError(f"{page}: the link {link} leads to no file")
        return os.path.relpath(place, PurePosixPath(self._places[page]).parent) + mark + anchor


def _file_page(name: str) -> str:
    return f"files/{name.replace('.', '_')}.md"


def _shown(name: str) -> str:
    """Return the page of a file that is not a page."""
    text = (ROOT / name).read_text(encoding="utf-8")
    language = _LANGUAGES.get(PurePosixPath(name).suffix, "text")
    return f"# {name}\n\n`````{language}\n{text.rstrip()}\n`````\n"


def _reference() -> str:
    """Return the part of the page of the public names that mkdocstrings completes."""
    entries = "\n".join(f"::: up.public.{name}\n" for name in public.__all__)
    return f"\n## Reference\n\nFrom the docstrings.\n\n{entries}"


def build(output: Path) -> Path:
    """Build the site of this version below ``output``; return its folder. Raises SiteError."""
    Stage(STAGE).write()
    site = output / VERSION
    epoch = subprocess.run(
        ["git", "log", "-1", "--format=%ct"], cwd=ROOT, capture_output=True, text=True
    ).stdout.strip()
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(site)],
        cwd=ROOT,
        env={
            "SOURCE_DATE_EPOCH": epoch or "0",
            **os.environ,
            "UP_DOCS_VERSION": f"Version {VERSION}",
        },
        capture_output=True,
        text=True,
    )
    if done.returncode:
        raise SiteError((done.stderr or done.stdout).strip())
    # The map for search engines has the time of the build; the rest is for other languages and for
    # authors of the theme.
    for each in (*site.glob("sitemap.xml*"), *site.rglob("*.map")):
        each.unlink()
    shutil.rmtree(site / "assets/javascripts/lunr")
    (output / "index.html").write_text(list_of_versions(output), encoding="utf-8")
    return site


def list_of_versions(output: Path) -> str:
    """Return the page that leads to the site of each version, the newest first."""
    found = [each.parent.name for each in output.glob("*/index.html")]
    numbered = sorted(found, key=lambda name: [int(n) for n in re.findall(r"\d+", name)])
    links = "".join(f'<li><a href="{n}/index.html">{n}</a></li>\n' for n in reversed(numbered))
    return (
        '<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>Up and Raspilot</title>\n'
        f"<h1>Up and Raspilot: documentation</h1>\n<ul>\n{links}</ul></html>\n"
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Build the site and the ground station's copy of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=ROOT / "build/site", metavar="DIR")
    output = parser.parse_args(arguments).output
    try:
        site = build(output.resolve())
    except SiteError as error:
        sys.exit(f"make docs: {error}")
    shutil.rmtree(SERVED, ignore_errors=True)
    shutil.copytree(site, SERVED)
    sys.stdout.write(f"{site / 'index.html'}\n")


if __name__ == "__main__":
    main()
