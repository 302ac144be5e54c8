"""The distribution metadata of a source folder, read without running its code."""

import ast
import re
import tomllib
from pathlib import Path
from typing import Any

_NAME = re.compile(r"[A-Za-z0-9]([A-Za-z0-9._-]*[A-Za-z0-9])?", re.ASCII)


def distribution_name(folder: Path) -> str:
    """Return the name of the distribution that a folder builds; empty if it is not a literal."""
    project = _table(folder / "pyproject.toml", "project")
    name = str(project.get("name", "")) or _name_in_setup(folder / "setup.py")
    return name if is_distribution_name(name) else ""


def is_distribution_name(name: str) -> bool:
    """Return whether the text is a valid distribution name."""
    return _NAME.fullmatch(name) is not None


def normal_name(name: str) -> str:
    """Return a distribution's normalized name: lower case, single dashes."""
    return re.sub(r"[-_.]+", "-", name).lower()


def neighbours(folder: Path) -> dict[str, Path]:
    """Return the distributions of a folder and of its siblings, by normalized name."""
    found: dict[str, Path] = {}
    for each in sorted(folder.parent.iterdir()):
        name = distribution_name(each) if each.is_dir() else ""
        if name:
            found[normal_name(name)] = each
    return found


def builds_with_setuptools(folder: Path) -> bool:
    """Return whether setuptools, not another tool, builds the distribution."""
    backend = _table(folder / "pyproject.toml", "build-system").get("build-backend", "setuptools")
    return str(backend).startswith("setuptools")


def _table(path: Path, name: str) -> dict[str, Any]:
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8")).get(name, {})
    except (OSError, ValueError, RecursionError):
        return {}
    return table if isinstance(table, dict) else {}


def _name_in_setup(path: Path) -> str:
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, SyntaxError, RecursionError, MemoryError):
        return ""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and _is_setup(node.func):
            for each in node.keywords:
                if each.arg == "name" and isinstance(each.value, ast.Constant):
                    return str(each.value.value)
    return ""


def _is_setup(function: ast.expr) -> bool:
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
    return name == "setup"
