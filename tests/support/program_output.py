"""What a program prints with ``UP_LOG_FORMAT=json``."""

from __future__ import annotations

import json
from typing import Any

AS_JSON = {"UP_LOG_FORMAT": "json"}


def fields_of(output: str) -> list[dict[str, Any]]:
    """Return the fields of each line that is JSON: its code, and the values in its text."""
    lines = (line for line in output.splitlines() if line.startswith("{") and line.endswith("}"))
    return [json.loads(line).get("fields", {}) for line in lines]
