"""The words for what the Arduino's status tells by numbers and bits (docs/protocols.md 2.7)."""

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
"""What forbids arming, from bit 0 on."""
RESET_CAUSES = ("power-on", "external", "brown-out", "watchdog")
"""Why the board started last, from bit 0 on."""
