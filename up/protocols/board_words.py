"""Texts for the numbers and bits of the Arduino's status (docs/protocols.md 2.7)."""

from __future__ import annotations

SWITCH_POSITIONS = {0: "low", 1: "middle", 2: "high"}
VETOES = (
    "the throttle is not low",
    "the receiver is invalid",
    "the IMU is invalid",
    "AUX2 is low",
    "the Raspberry Pi vetoes",
    "calibrating",
    "the profile is invalid",
    "a veto that this program does not know",
)
"""The reasons against arming, from bit 0 on."""
RESET_CAUSES = ("power-on", "external", "brown-out", "watchdog")
"""The cause of the board's last start, from bit 0 on."""
