"""The name of an aircraft, wherever one is accepted (docs/protocols.md, section 9)."""

import re

AIRCRAFT_NAME = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,31}", re.ASCII)
"""To be matched as a whole; a folder can have this name, so it does not begin with a dot."""
AIRCRAFT_NAME_RULE = "1 to 32 letters, digits, _ . or -, and not begin with a dot"
