"""The profile of the airframe that the Arduino stores (docs/protocols.md 2.6)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from struct import Struct

from up.commands.board_schema import SWITCH_MODES
from up.flight_controller.airframe_profile import MIXES

_PROFILE = Struct(">" + "BhHH" * 4 + "BB3s" + "3h2h" + "2H" + "3H" + "B")
PROFILE_SIZE = _PROFILE.size
_CENTI = 100


@dataclass(frozen=True, slots=True)
class Channel:
    """One servo output: direction, trim (us) and end points (us)."""

    reversed: bool
    trim_us: int
    lowest_us: int
    highest_us: int


@dataclass(frozen=True, slots=True)
class Profile:
    """The airframe profile of the Arduino; ``switch`` gives the modes of AUX1 low, middle, high."""

    ailerons: Channel
    elevator: Channel
    throttle: Channel
    rudder: Channel
    mix: str
    has_motor: bool
    switch: tuple[str, str, str]
    roll_limit_deg: float
    pitch_up_limit_deg: float
    pitch_down_limit_deg: float
    glide_pitch_deg: float
    circle_bank_deg: float
    throttle_failsafe_us: int
    throttle_lost_us: int
    preset_ailerons_us: int
    preset_elevator_us: int
    preset_rudder_us: int
    may_return_with_motor: bool


def pack_profile(profile: Profile) -> bytes:
    """Return the 54 bytes of `C`; raises ValueError naming the value out of range."""
    channels = (profile.ailerons, profile.elevator, profile.throttle, profile.rudder)
    for channel in channels:
        if not -200 <= channel.trim_us <= 200:
            raise ValueError(f"a trim is -200 to 200 us, not {channel.trim_us}")
        if not 800 <= channel.lowest_us < channel.highest_us <= 2200:
            raise ValueError(
                f"end points are 800 to 2200 us, not {channel.lowest_us} to {channel.highest_us}"
            )
    letters = {name: letter for letter, name in SWITCH_MODES.items()}
    if profile.mix not in MIXES or not set(profile.switch) <= set(letters):
        raise ValueError("the mix or a mode of the switch is not known")
    angles = (
        profile.roll_limit_deg,
        profile.pitch_up_limit_deg,
        profile.pitch_down_limit_deg,
        profile.glide_pitch_deg,
        profile.circle_bank_deg,
    )
    if not all(-90 <= angle <= 90 for angle in angles) or min(angles[:3]) < 0:
        raise ValueError("an angle of the profile is out of range")
    pulses = (
        profile.throttle_failsafe_us,
        profile.preset_ailerons_us,
        profile.preset_elevator_us,
        profile.preset_rudder_us,
    )
    if (
        not all(800 <= pulse <= 2200 for pulse in pulses)
        or not 0 <= profile.throttle_lost_us <= 2200
    ):
        raise ValueError("a pulse of the profile is out of range")
    return _PROFILE.pack(
        *chain.from_iterable(
            (each.reversed, each.trim_us, each.lowest_us, each.highest_us) for each in channels
        ),
        MIXES.index(profile.mix),
        profile.has_motor,
        "".join(letters[name] for name in profile.switch).encode("ascii"),
        *(round(angle * _CENTI) for angle in angles),
        profile.throttle_failsafe_us,
        profile.throttle_lost_us,
        profile.preset_ailerons_us,
        profile.preset_elevator_us,
        profile.preset_rudder_us,
        profile.may_return_with_motor,
    )


def read_profile(payload: bytes) -> Profile:
    """Decode the 54 bytes of `C`; raises ValueError for an unknown mix or mode."""
    fields = _PROFILE.unpack(payload)
    channels = [Channel(bool(fields[at] & 1), *fields[at + 1 : at + 4]) for at in (0, 4, 8, 12)]
    mix, motor, letters, *angles = fields[16:24]
    try:
        low, middle, high = (SWITCH_MODES[chr(letter)] for letter in letters)
        mix_name = MIXES[mix]
    except (KeyError, IndexError):
        raise ValueError("the mix or a mode of the switch is not known") from None
    ailerons, elevator, throttle, rudder = channels
    roll_limit, pitch_up_limit, pitch_down_limit, glide_pitch, circle_bank = angles
    throttle_failsafe_us, throttle_lost_us, *preset_us, flags = fields[24:30]
    return Profile(
        ailerons=ailerons,
        elevator=elevator,
        throttle=throttle,
        rudder=rudder,
        mix=mix_name,
        has_motor=bool(motor),
        switch=(low, middle, high),
        roll_limit_deg=roll_limit / _CENTI,
        pitch_up_limit_deg=pitch_up_limit / _CENTI,
        pitch_down_limit_deg=pitch_down_limit / _CENTI,
        glide_pitch_deg=glide_pitch / _CENTI,
        circle_bank_deg=circle_bank / _CENTI,
        throttle_failsafe_us=throttle_failsafe_us,
        throttle_lost_us=throttle_lost_us,
        preset_ailerons_us=preset_us[0],
        preset_elevator_us=preset_us[1],
        preset_rudder_us=preset_us[2],
        may_return_with_motor=bool(flags & 1),
    )
