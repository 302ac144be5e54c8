"""``up update``: upgrades Up from its installation source."""

import argparse
import importlib.metadata
import json
import shlex
import sys
import urllib.parse
from typing import Any

from up.cli.cli_error import CliError
from up.cogs import pip
from up.output import echo
from up.version import VERSION


def run(values: argparse.Namespace) -> int:
    """Upgrade the distribution that contains this command."""
    command = [sys.executable, "-P", "-m", "pip", "install", *_what()]
    if values.dry_run:
        echo(shlex.join(command))
        return 0
    pip.check_environment()
    echo(f"Up {VERSION} in {sys.prefix}: {shlex.join(command[2:])}")
    pip.run_pip([*command, "--no-input", "--disable-pip-version-check"])
    echo("done; 'up --version' tells the version")
    return 0


def _what() -> list[str]:
    """Return the requirement for pip, from its record of the installation (PEP 610)."""
    try:
        found = importlib.metadata.distribution(pip.FRAMEWORK)
    except importlib.metadata.PackageNotFoundError:
        raise CliError(
            "Up runs from its source folder and is not installed: update that", code="not_installed"
        ) from None
    origin: dict[str, Any] = json.loads(found.read_text("direct_url.json") or "{}")
    url = str(origin.get("url", ""))
    if not url:
        return ["--upgrade", pip.FRAMEWORK]
    if "vcs_info" in origin:
        details = origin["vcs_info"]
        revision = details.get("requested_revision")
        address = f"{details['vcs']}+{url}" + (f"@{revision}" if revision else "")
        return ["--upgrade", f"{pip.FRAMEWORK} @ {address}"]
    folder = urllib.parse.unquote(urllib.parse.urlsplit(url).path)
    if "dir_info" not in origin:
        raise CliError(
            f"Up was installed from the file {folder}: install a newer file with pip",
            code="not_upgradable",
        )
    echo(f"Up is installed from the folder {folder}: bring that up to date first (git pull)")
    if origin["dir_info"].get("editable"):
        return ["--no-build-isolation", "--editable", folder]
    return ["--no-build-isolation", "--upgrade", folder]
