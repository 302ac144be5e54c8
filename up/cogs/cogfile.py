"""Cogfile.yml: which cogs an application wants, and where they come from (thesis 4.3.2)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from up.cogs.cog_error import CogError
from up.cogs.package_name import package_name
from up.config import ConfigErrors, ConfigProblem, key
from up.config.map_file import MapFile
from up.config.nodes import MapNode, ScalarNode, compose
from up.config.reading import read_text

COGFILE = "Cogfile.yml"

_DISTRIBUTION = re.compile(r"[A-Za-z0-9]([A-Za-z0-9._-]*[A-Za-z0-9])?", re.ASCII)
_VERSION = re.compile(r"[0-9]+[A-Za-z0-9.!+]*", re.ASCII)
_REVISION = re.compile(r"[A-Za-z0-9][A-Za-z0-9._/-]*", re.ASCII)
_URL = re.compile(r"(git\+)?(https|ssh|file)://[^\s@#]*(@[^\s@#/]+/[^\s@#]*)?", re.ASCII)


@dataclass(frozen=True, slots=True)
class CogSpec:
    """Where a cog comes from."""

    path: str = key("", "Folder with the cog's setup.py, from the Cogfile.", max_length=1000)
    pypi: str = key("", "Name of the distribution on the package index.", max_length=200)
    version: str = key("", "The one version that is wanted from the index.", max_length=100)
    url: str = key("", "Git repository of the cog.", max_length=1000)
    revision: str = key("", "Branch, tag or commit of the repository.", max_length=200)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield what is not usable or does not fit together."""
        if self.pypi and not _DISTRIBUTION.fullmatch(self.pypi):
            yield "pypi", "must be the name of a distribution, like raspilot-serial-cog"
        if self.version and not _VERSION.fullmatch(self.version):
            yield "version", 'must be one version, like "1.2.3"'
        if self.url and not _URL.fullmatch(self.url):
            yield "url", "must be an https://, ssh:// or file:// address of a git repository"
        if self.revision and not _REVISION.fullmatch(self.revision):
            yield "revision", "must be a branch, a tag or a commit"
        if self.version and not self.pypi:
            yield "version", "goes with pypi"
        if self.revision and not self.url:
            yield "revision", "goes with url"


@dataclass(frozen=True, slots=True)
class WantedCog:
    """One entry of a Cogfile: the cog's package, its source, and the folder for a path."""

    cog: str
    spec: CogSpec
    folder: Path | None


_FILE = MapFile(COGFILE, CogSpec)


def load_cogfile(root: Path) -> list[WantedCog]:
    """Return what the Cogfile in an application's folder asks for; nothing where there is none.

    Raises ConfigErrors with the place of every mistake.
    """
    problems: list[ConfigProblem] = []
    specs: dict[str, CogSpec] = {}
    try:
        specs = _FILE.load(root)
    except ConfigErrors as errors:
        problems += errors.problems
    path = root / COGFILE
    wanted: list[WantedCog] = []
    seen: dict[str, str] = {}
    for label, line, column in _labels(path):

        def report(what: str, place: tuple[int, int] = (line, column)) -> None:
            problems.append(ConfigProblem(path, *place, what))

        cog = _package(label, seen, report)
        spec = specs.get(label)
        if cog is not None and spec is not None:
            folder = _source(root, label, spec, report)
            wanted.append(WantedCog(cog, spec, folder))
    if problems:
        raise ConfigErrors(sorted(problems, key=lambda each: (each.line, each.column)))
    return wanted


def _package(label: str, seen: dict[str, str], report: Callable[[str], None]) -> str | None:
    try:
        cog = package_name(label)
    except CogError as error:
        report(str(error))
        return None
    if cog in seen and seen[cog] != label:
        report(f"{label} and {seen[cog]} are the same cog, {cog}")
        return None
    seen[cog] = label
    return cog


def _source(root: Path, label: str, spec: CogSpec, report: Callable[[str], None]) -> Path | None:
    given = [name for name in ("path", "pypi", "url") if getattr(spec, name)]
    if len(given) != 1:
        found = " and ".join(given) if given else "none of them"
        report(f"{label}: give exactly one of path, pypi and url; here is {found}")
        return None
    if not spec.path:
        return None
    folder = (root / spec.path).resolve()
    if not any((folder / name).is_file() for name in ("setup.py", "pyproject.toml")):
        report(f"{label}: there is no setup.py in {folder}")
    return folder


def _labels(path: Path) -> Iterator[tuple[str, int, int]]:
    """Yield the top keys and their places; what the file reader has reported is passed over."""

    def ignore(line: int, column: int, what: str) -> None:
        """Leave the problem to the reader that has reported it."""

    text = read_text(path, ignore)
    root = None if text is None else compose(text, ignore)
    if isinstance(root, MapNode):
        for name, _ in root.pairs:
            if isinstance(name, ScalarNode):
                yield name.text, name.line, name.column
