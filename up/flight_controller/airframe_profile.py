"""The keys of airframe.yml: the required profile of the board; null values stay unchanged."""

from collections.abc import Iterator

from up.commands.board_schema import SWITCH_MODES
from up.commands.flight_state_command import DEFAULT_LIMITS_DEG
from up.config import key, section
from up.quick_dataclass import dataclass

MIXES = ("none", "elevon", "V-tail")
MODES = tuple(SWITCH_MODES.values())


def _pulse(comment: str, least: int = 800, most: int = 2200) -> int | None:
    return key(None, comment, unit="us", minimum=least, maximum=most)


def _angle(comment: str, least: float = 0.0) -> float | None:
    return key(None, comment, unit="deg", minimum=least, maximum=90)


SLEW_STEP_PERCENT_S = 5
MAX_SLEW_PERCENT_S = 63 * SLEW_STEP_PERCENT_S


def _default(limit: str) -> str:
    return f"Board default: {DEFAULT_LIMITS_DEG[limit]:g}."


def _switch(comment: str) -> str | None:
    return key(None, comment, choices=MODES, ignore_case=True)


@dataclass(frozen=True, slots=True)
class Servo:
    """One servo output."""

    reversed: bool | None = key(None, "Whether it turns the other way.")
    trim_us: int | None = _pulse("Added to every pulse. Board default: 0.", -200, 200)
    lowest_us: int | None = _pulse("Shortest pulse that it gets. Board default: 1000.")
    highest_us: int | None = _pulse("Longest pulse that it gets. Board default: 2000.")

    def problems(self) -> Iterator[tuple[str, str]]:
        if (
            self.lowest_us is not None
            and self.highest_us is not None
            and self.lowest_us >= self.highest_us
        ):
            yield "highest_us", f"must be above lowest_us, which is {self.lowest_us}"


@dataclass(frozen=True, slots=True)
class Switch:
    """What the positions of the mode switch (AUX1) select.

    ACRO passes the sticks through, RATE holds rotation rates, FBW attitudes, and AUTO is the only
    position in which the Raspberry Pi and the ground may fly.
    """

    low: str | None = _switch("Below 1300 us. Board default: ACRO.")
    middle: str | None = _switch("1300 to 1700 us. Board default: FBW.")
    high: str | None = _switch("Above 1700 us. Board default: AUTO.")


@dataclass(frozen=True, slots=True)
class FlyByWire:
    """How far the sticks bank and pitch the aeroplane in FBW, on the board and on the Pi."""

    roll_deg: float | None = _angle(f"Greatest bank. {_default('roll_deg')}")
    pitch_up_deg: float | None = _angle(f"Greatest pitch up. {_default('pitch_up_deg')}")
    pitch_down_deg: float | None = _angle(f"Greatest pitch down. {_default('pitch_down_deg')}")


@dataclass(frozen=True, slots=True)
class ReceiverLost:
    """What happens without the receiver: a stabilised gentle circle, else the preset surfaces."""

    below_us: int | None = _pulse(
        "A throttle pulse below this is the receiver's own failsafe. Board default: 900.", 0
    )
    throttle_us: int | None = _pulse("The throttle output then. Board default: 1000.")
    glide_pitch_deg: float | None = _angle(
        "Pitch of the circle, nose up positive. Board default: -3.", -90.0
    )
    circle_bank_deg: float | None = _angle(
        "Bank of the circle, right wing down positive. Board default: 20.", -90.0
    )
    ailerons_us: int | None = _pulse("The ailerons without IMU. Board default: 1500.")
    elevator_us: int | None = _pulse("The elevator without IMU. Board default: 1500.")
    rudder_us: int | None = _pulse("The rudder without IMU. Board default: 1500.")
    return_with_motor: bool | None = key(
        None,
        "Whether the Raspberry Pi's set-points may use the motor then. Board default: false.",
    )
    pi_may_fly: bool | None = key(
        None,
        "Whether the board then follows the Raspberry Pi's set-points for the return flight instead"
        " of circling. Board default: false.",
    )


@dataclass(frozen=True, slots=True)
class AirframeProfile:
    """The airframe that the board flies: servos, switch, limits, failsafe.

    The board stores its own profile: null and missing values here leave it unchanged.
    Every other value is compared with the board's whenever it answers, and sent where it differs
    and only while it is disarmed; until it holds them all, arming is refused. An old firmware
    (framing: thesis) gets nothing of this.
    """

    ailerons: Servo = section(Servo, "The output at pin D9; with mix: elevon the left one.")
    elevator: Servo = section(Servo, "The output at pin D10; with mix: elevon the right one.")
    throttle: Servo = section(Servo, "The output at pin D3: the motor's ESC, or a brake or tow.")
    rudder: Servo = section(Servo, "The output at pin D11.")
    mix: str | None = key(
        None,
        "How surfaces are shared: elevon mixes ailerons and elevator, V-tail elevator and rudder."
        " Board default: none.",
        choices=MIXES,
        ignore_case=True,
    )
    motor: bool | None = key(
        None,
        "Whether the throttle drives a motor, which needs arming. false is a glider, whose Outputs"
        " need no arming. Board default: true.",
    )
    throttle_slew_percent_s: int | None = key(
        None,
        "How fast a motor's throttle rises at most; it falls at once. In steps of"
        f" {SLEW_STEP_PERCENT_S}; 0 is no limit. Board default: 0.",
        minimum=0,
        maximum=MAX_SLEW_PERCENT_S,
        unit="%/s",
    )
    switch: Switch = section(Switch)
    fly_by_wire: FlyByWire = section(FlyByWire)
    receiver_lost: ReceiverLost = section(ReceiverLost)
