"""Cogfile.yml: the cogs that an application uses, and their sources (thesis 4.3.2)."""

import re
from collections.abc import Iterator
from pathlib import Path

from up.cogs.cog import CogError, package_name
from up.cogs.source_tree import is_distribution_name
from up.config import key
from up.config.file import read_tree
from up.config.nodes import MapNode, Node, Report, ScalarNode
from up.config.problems import Problems
from up.config.scalars import is_null
from up.config.schema import schema_of
from up.config.validator import Validator
from up.quick_dataclass import dataclass

COGFILE = "Cogfile.yml"

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

    def problems(self) -> Iterator[tuple[str, str] | tuple[str, str, str]]:
        if not self.path.isprintable():
            yield "path", "must be the path of a folder", "bad_format"
        if self.pypi and not is_distribution_name(self.pypi):
            what = "must be the name of a distribution, like raspilot-radio-cog"
            yield "pypi", what, "bad_format"
        if self.version and not _VERSION.fullmatch(self.version):
            yield "version", 'must be one version, like "1.2.3"', "bad_format"
        if self.url and not _URL.fullmatch(self.url):
            what = "must be an https://, ssh:// or file:// address of a git repository"
            yield "url", what, "bad_format"
        if self.revision and not _REVISION.fullmatch(self.revision):
            yield "revision", "must be a branch, a tag or a commit", "bad_format"
        if self.version and not self.pypi:
            yield "version", "goes with pypi"
        if self.revision and not self.url:
            yield "revision", "goes with url"


@dataclass(frozen=True, slots=True)
class WantedCog:
    """One entry of a Cogfile: the cog's package, its source, and the base folder for a path."""

    cog: str
    spec: CogSpec
    folder: Path | None


_SCHEMA = schema_of(CogSpec)


def load_cogfile(root: Path) -> list[WantedCog]:
    """Return the entries of the Cogfile in an application's folder; empty without a Cogfile.

    Raises ConfigErrors with the place of every error.
    """
    path = root / COGFILE
    problems = Problems(path)
    tree = read_tree(path, problems.report)
    wanted: list[WantedCog] = []
    if isinstance(tree, MapNode):
        seen: dict[str, str] = {}
        for name, value in tree.pairs:
            label = name.text if isinstance(name, ScalarNode) else ""
            each = _Entry(root, label, name, problems.report).read(value, seen)
            if each is not None:
                wanted.append(each)
    elif tree is not None:
        problems.report(tree.line, tree.column, "must be a map of cogs", "wrong_type")
    problems.raise_if_any()
    return wanted


@dataclass(frozen=True, slots=True)
class _Entry:
    """One entry during reading; its problems are reported at its name."""

    root: Path
    label: str
    name: Node
    report: Report

    def read(self, value: Node, seen: dict[str, str]) -> WantedCog | None:
        try:
            cog = package_name(self.label)
        except CogError as error:
            self._refuse(str(error), "bad_format")
            cog = ""
        if cog and cog in seen:
            self._refuse(f"{self.label} is repeated, first as {seen[cog]}", "key_repeated")
        seen[cog] = self.label
        spec = (
            CogSpec()
            if is_null(value)
            else Validator(self.report, {}).read(_SCHEMA, value, self.label)
        )
        if not isinstance(spec, CogSpec):
            return None
        folder = self._folder(spec)
        return WantedCog(cog, spec, folder) if cog else None

    def _folder(self, spec: CogSpec) -> Path | None:
        given = [name for name in ("path", "pypi", "url") if getattr(spec, name)]
        if len(given) != 1:
            found = " and ".join(given) if given else "none"
            what = f"{self.label}: give one of path, pypi and url; here is {found}"
            self._refuse(what, "source_unclear")
            return None
        if not spec.path:
            return None
        folder = (self.root / spec.path).resolve()
        if not any((folder / name).is_file() for name in ("setup.py", "pyproject.toml")):
            self._refuse(f"{self.label}: setup.py is missing in {folder}", "source_missing")
        return folder

    def _refuse(self, what: str, code: str) -> None:
        self.report(self.name.line, self.name.column, what, code, self.label)
