#!/usr/bin/env python3
"""Writes the forms of the Commands that the app shows: ``android/raspilot/assets/commands.json``.

The forms equal those of the ground station's page: every
Command that a ground may send, of Up and of every installed cog. The same Commands give the same
bytes.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

try:
    from up_ground.catalogue import Catalogue, catalogue_message
except ModuleNotFoundError as error:
    sys.exit(
        f"{error}: tools/phone_commands.py wants the project's own Python, which make run sets up:"
        " .venv/bin/python tools/phone_commands.py"
    )

ASSET = Path(__file__).resolve().parent.parent / "android" / "raspilot" / "assets" / "commands.json"


def asset_text(catalogue: Catalogue) -> str:
    """Return the content of the file; raises ValueError if a Command would be missing."""
    if catalogue.problems:
        raise ValueError(catalogue.problems[0])
    message = catalogue_message(catalogue)
    lacking = len(catalogue.sendable()) - len(message["commands"])
    if lacking:
        raise ValueError(f"the catalogue has become too long, it lacks {lacking} Commands")
    return json.dumps(message, indent=1) + "\n"


def main(arguments: list[str]) -> int:
    """Write the file and report it; 1 if it was left unchanged, with the reason."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "path", nargs="?", type=Path, default=ASSET, help="default: the app's asset"
    )
    path = parser.parse_args(arguments).path
    try:
        text = asset_text(Catalogue.installed())
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="ascii")
    except (OSError, ValueError) as error:
        sys.stderr.write(f"{path} is not written: {error}\n")
        return 1
    sys.stdout.write(f"{path}: {text.count('needs_beacon')} Commands\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
