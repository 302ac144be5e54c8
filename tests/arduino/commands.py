"""Payloads of Commands that several tests send, and a bench's way to change the profile."""

import struct

from up.commands.flight_state_command import DEFAULT_LIMITS_DEG

SERVOS = ("ailerons", "elevator", "throttle", "rudder")
# docs/protocols.md 2.6, with what the firmware boots with.
SERVO = {"reversed": 0, "trim_us": 0, "lowest_us": 1000, "highest_us": 2000}
AIRFRAME = {
    "mix": 0,
    "motor": 1,
    "switch": b"afA",
    **{
        name.replace("_deg", "_limit_cdeg"): round(100 * limit_deg)
        for name, limit_deg in DEFAULT_LIMITS_DEG.items()
    },
    "glide_pitch_cdeg": -300,
    "circle_bank_cdeg": 2000,
    "throttle_failsafe_us": 1000,
    "throttle_lost_us": 900,
    "preset_ailerons_us": 1500,
    "preset_elevator_us": 1500,
    "preset_rudder_us": 1500,
    "flags": 0,
}


def setpoint(roll=0, pitch=0, yaw_rate=0, throttle=0, lifetime_ms=250):
    return struct.pack(">3h2H", roll, pitch, yaw_rate, throttle, lifetime_ms)


def outputs(flight, ailerons=1500, elevator=1500, throttle=0, rudder=1500, sequence=None):
    if sequence is None:
        sequence = flight.orientation_sequence()
    return struct.pack(">5H", ailerons, elevator, throttle, rudder, sequence)


def profile(servos=None, **changes):
    """Return a profile; ``servos`` is for example ``{"rudder": {"reversed": 1}}``."""
    servos = servos or {}
    assert not set(servos) - set(SERVOS) and not set(changes) - set(AIRFRAME)
    parts = [SERVO | servos.get(name, {}) for name in SERVOS]
    ends = b"".join(struct.pack(">BhHH", *each.values()) for each in parts)
    return ends + struct.pack(">BB3s5h5HB", *(AIRFRAME | changes).values())
