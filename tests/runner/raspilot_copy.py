"""A copy of Raspilot with chosen cogs, for a runner to start."""

import importlib.util
import shutil
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]


def copy_of_raspilot(root, cogs):
    """Copy Raspilot with some cogs registered and nothing else; return a runner's settings."""
    ignored = shutil.ignore_patterns("__pycache__", "external_modules.yml")
    shutil.copytree(ROOT / "raspilot", root / "raspilot", ignore=ignored)
    shutil.copy(ROOT / "main.py", root)
    external = {}
    for cog in cogs:
        folder = Path(importlib.util.find_spec(cog).origin).parent
        registered = yaml.safe_load((folder / "registered_modules.yml").read_text())
        modules = registered["modules"] if isinstance(registered, dict) else registered
        external[cog] = {"source": "manual", "modules": modules}
    (root / "raspilot" / "external_modules.yml").write_text(yaml.safe_dump(external))
    return {"application root": str(root), "script path": "main.py", "start limit": 60}
