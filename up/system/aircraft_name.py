"""The syntax of an aircraft's name (docs/protocols.md, section 9)."""

import re

AIRCRAFT_NAME = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,31}", re.ASCII)
"""Match it as a whole. A folder may have this name, so it does not begin with a dot."""
AIRCRAFT_NAME_RULE = "1 to 32 letters, digits, _ . or -, and not begin with a dot"
