"""Colours for light and dark pages.

The lines of one panel can be distinguished with colour blindness (Okabe and Ito 2008); the dark
theme uses the same hues, lighter.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Theme:
    """The colours of a picture; the report's page has the same background and text colours."""

    paper: str
    ink: str
    muted: str
    grid: str
    blue: str
    orange: str
    green: str
    vermilion: str
    purple: str
    sky: str
    bands: dict[str, str]
    other_band: str

    def band(self, mode: str) -> str:
        return self.bands.get(mode, self.other_band)


DAYLIGHT = Theme(
    paper="#ffffff",
    ink="#1b2026",
    muted="#5b646e",
    grid="#dfe3e8",
    blue="#0072b2",
    orange="#d98200",
    green="#008f68",
    vermilion="#d55e00",
    purple="#b5588f",
    sky="#3f9fd8",
    bands={
        "ACRO": "#edeff2",
        "RATE": "#fbf2d9",
        "FBW": "#e3f1eb",
        "SETPOINT": "#dfecf8",
        "RETURN": "#dfecf8",
        "OUTPUT": "#e9e4f5",
        "RTH": "#f7e6f0",
        "failsafe": "#fae5de",
    },
    other_band="#dfecf8",
)
DARK = Theme(
    paper="#12161b",
    ink="#e8ebee",
    muted="#9aa4ae",
    grid="#293038",
    blue="#62aef0",
    orange="#f2b13c",
    green="#41cda0",
    vermilion="#ff8352",
    purple="#dc9cc4",
    sky="#9ad6ff",
    bands={
        "ACRO": "#20252b",
        "RATE": "#2e2919",
        "FBW": "#16302a",
        "SETPOINT": "#172b3f",
        "RETURN": "#172b3f",
        "OUTPUT": "#28223b",
        "RTH": "#362133",
        "failsafe": "#3a201b",
    },
    other_band="#172b3f",
)
