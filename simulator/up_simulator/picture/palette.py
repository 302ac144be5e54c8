"""Colours distinguishable with every colour vision (Okabe and Ito 2008)."""

from __future__ import annotations

INK = "#222222"
MUTED = "#5f6368"
GRID = "#dcdfe3"
PAPER = "#ffffff"

BLUE = "#0072B2"
SKY = "#56B4E9"
GREEN = "#009E73"
ORANGE = "#E69F00"
VERMILION = "#D55E00"
PURPLE = "#CC79A7"
BLACK = "#000000"

TRUTH, ESTIMATE, DEMAND = BLUE, ORANGE, BLACK
CHANNELS = {"ailerons": BLUE, "elevator": VERMILION, "throttle": GREEN, "rudder": PURPLE}
FAULT = VERMILION
SHADE, SHADE_EDGE = "#fdeae0", "#eeb091"
"""Where an expectation was not held."""

BANDS = {
    "ACRO": "#eceef0",
    "RATE": "#fdf1d3",
    "FBW": "#dcefe8",
    "SETPOINT": "#dbeaf6",
    "RETURN": "#dbeaf6",
    "OUTPUT": "#e7e1f3",
    "AUTO": "#dbeaf6",
    "RTH": "#f6e3ee",
    "FAILSAFE": "#f3d0e2",
}
OTHER_BAND = "#f2f2f2"
"""For modes without a colour; the name is printed in the strip above the panels."""
