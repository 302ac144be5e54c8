"""Whether a cog is installed, and from the source that the Cogfile names."""

import importlib
import importlib.util
import json
import urllib.parse
from importlib.metadata import Distribution, PackageNotFoundError, distribution, distributions
from pathlib import Path
from typing import Any

from up.cogs.cogfile import WantedCog
from up.cogs.source_tree import distribution_name


def is_installed(wanted: WantedCog) -> bool:
    """Return whether the cog can be imported and comes from the Cogfile's source, none older."""
    importlib.invalidate_caches()
    if _package_folder(wanted.cog) is None:
        return False
    if wanted.folder is not None:
        return _is_from_folder(wanted.cog, wanted.folder)
    found = distribution_of(wanted.cog, wanted.spec.pypi)
    if found is None:
        return False
    if wanted.spec.url:
        return _is_from_git(found, wanted.spec.url, wanted.spec.revision)
    return not wanted.spec.version or _plain(found.version) == _plain(wanted.spec.version)


def _is_from_folder(cog: str, folder: Path) -> bool:
    name = distribution_name(folder)
    found = distribution_of(cog, name)
    if found is None or _is_older(found, folder):
        return False
    package = _package_folder(cog)
    if package is not None and package.is_relative_to(folder):
        return True
    address = urllib.parse.urlsplit(str(_direct_url(found).get("url", "")))
    return address.scheme == "file" and Path(urllib.parse.unquote(address.path)) == folder


def _is_older(found: Distribution, folder: Path) -> bool:
    """Return whether the folder's packaging changed since: entry points, requirements."""
    metadata = next((each.locate() for each in found.files or () if each.name == "METADATA"), None)
    if metadata is None:
        return False
    files = [folder / name for name in ("setup.py", "setup.cfg", "pyproject.toml")]
    try:
        installed_s = Path(str(metadata)).stat().st_mtime
        return any(each.stat().st_mtime > installed_s for each in files if each.is_file())
    except OSError:
        return False


def _is_from_git(found: Distribution, url: str, revision: str) -> bool:
    origin = _direct_url(found)
    details = origin.get("vcs_info")
    if not isinstance(details, dict) or origin.get("url") != url.removeprefix("git+"):
        return False
    commit = str(details.get("commit_id", ""))
    return not revision or details.get("requested_revision") == revision or commit == revision


def _package_folder(cog: str) -> Path | None:
    try:
        spec = importlib.util.find_spec(cog)
    except (ImportError, ValueError):
        return None
    if spec is None or spec.origin is None:
        return None
    return Path(spec.origin).resolve().parent


def distribution_of(cog: str, name: str = "") -> Distribution | None:
    """Return the distribution of that name, or the one that declares the package."""
    for each in (name, cog, f"raspilot-{cog}"):
        try:
            return distribution(each)
        except (PackageNotFoundError, ValueError):
            continue
    return next((each for each in distributions() if _brings(each, cog)), None)


def _brings(found: Distribution, cog: str) -> bool:
    return cog in (found.read_text("top_level.txt") or "").split()


def _direct_url(found: Distribution) -> dict[str, Any]:
    """Return the installation source that pip recorded (PEP 610); empty for the index."""
    try:
        origin = json.loads(found.read_text("direct_url.json") or "{}")
    except ValueError:
        return {}
    return origin if isinstance(origin, dict) else {}


def _plain(version: str) -> str:
    text = version.lower()
    while text.endswith(".0"):
        text = text[:-2]
    return text
