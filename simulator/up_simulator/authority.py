"""Who flies: the switch, arming, the Raspberry Pi's Outputs, and what the servos get.

The stand-in has no stabilisation of its own: where the firmware would hold level it passes the
sticks through, and its mode letter says so.
"""

from __future__ import annotations

from up_simulator.flight import NEUTRAL, Servos
from up_simulator.memory import default_profile
from up_simulator.reason import Reason, RefusedError
from up_simulator.receiver import Receiver

LIVES_S = 0.25
ASKED_LIVES_S = 0.5
RECEIVER_LOST_S = 0.1
RECEIVER_GONE_S = 1.0
THROTTLE_LATCH_S = 5.0
DEBOUNCE_S = 0.3
LOW_LONG_ENOUGH_S = 2.0
LOW_THROTTLE_US = 1050
MIDDLE_US, HIGH_US = 1300, 1700
PULSE_VALID_US = (885, 2115)
DISARMED_THROTTLE_US = 1000

ACRO, OUTPUT, SETPOINT, AUTO = "a", "u", "s", "A"


class Authority:
    """Decides from the receiver, the switch and the Raspberry Pi what the servos get.

    Times are seconds of the caller's clock. Requests raise ``RefusedError``.
    """

    def __init__(self, receiver: Receiver, has_motor: bool) -> None:
        self._receiver = receiver
        self.profile = default_profile(has_motor)
        self.is_armed = False
        self.is_calibrating = False
        self.switch: int | None = None
        self.veto_until_s = 0.0
        self._asked: str | None = None
        self._asked_until_s = 0.0
        self._output: Servos | None = None
        self._output_until_s = 0.0
        self._throttle_demand_us = 0
        self._demand_until_s = 0.0
        self._aux2_is_high: bool | None = None
        self._aux2_since_s = 0.0
        self._aux2_settled: bool | None = None
        self._throttle_low_since_s: float | None = None
        self._is_throttle_latched = False

    def on_pulses(self, now_s: float) -> None:
        """Take a new set of pulses: the switch, the arming edge, the throttle."""
        # A receiver's own failsafe moves channels: that is no pilot.
        if not self.has_receiver(now_s):
            return
        aux1_us, aux2_us = self._receiver.pulses_us[4:6]
        self.switch = (aux1_us >= MIDDLE_US) + (aux1_us >= HIGH_US)
        if not self.is_auto:
            self._asked = None
            self._output_until_s = self._demand_until_s = 0.0
        if not self.is_throttle_low:
            self._throttle_low_since_s = None
        elif self._throttle_low_since_s is None:
            self._throttle_low_since_s = now_s
        if self.is_throttle_low:
            self._is_throttle_latched = False
        self._follow_aux2(aux2_us >= (MIDDLE_US + HIGH_US) // 2, now_s)

    def _follow_aux2(self, is_high: bool, now_s: float) -> None:
        if is_high is not self._aux2_is_high:
            self._aux2_is_high = is_high
            self._aux2_since_s = now_s
        if now_s - self._aux2_since_s < DEBOUNCE_S or self._aux2_settled is is_high:
            return
        was_low = self._aux2_settled is False
        self._aux2_settled = is_high
        if not is_high:
            self.is_armed = False
        elif was_low and not self.vetoes(now_s):
            self.is_armed = True

    def age_s(self, now_s: float) -> float:
        """Return the age of the newest pulses; infinite before the first."""
        heard_s = self._receiver.heard_s
        return float("inf") if heard_s is None else now_s - heard_s

    def channel_validity(self, now_s: float) -> int:
        """Return a bit for each channel whose pulse is fresh and within 885 to 2115 us."""
        if self.age_s(now_s) > RECEIVER_LOST_S:
            return 0
        low_us, high_us = PULSE_VALID_US
        pulses_us = self._receiver.pulses_us
        return sum((low_us <= pulse <= high_us) << bit for bit, pulse in enumerate(pulses_us))

    def has_receiver(self, now_s: float) -> bool:
        """Return whether all six channels are valid and it is not in its own failsafe."""
        return self.channel_validity(now_s) == 0x3F and (
            self._receiver.pulses_us[2] >= self.profile.throttle_lost_us
        )

    def is_failsafe(self, now_s: float) -> bool:
        """Return whether the receiver has been lost for long enough to act on it."""
        return self.age_s(now_s) >= RECEIVER_GONE_S or (
            self.age_s(now_s) <= RECEIVER_LOST_S and not self.has_receiver(now_s)
        )

    @property
    def is_auto(self) -> bool:
        """Return whether the switch stands at AUTO."""
        return self.switch is not None and self.profile.switch[self.switch] == AUTO

    @property
    def is_throttle_low(self) -> bool:
        """Return whether the throttle stick is low."""
        return self._receiver.pulses_us[2] < LOW_THROTTLE_US

    def vetoes(self, now_s: float) -> int:
        """Return the veto bits of the status (protocols 2.7)."""
        has_motor = self.profile.has_motor
        return (
            (has_motor and not self.is_throttle_low)
            | (not self.has_receiver(now_s)) << 1
            | (self._aux2_settled is not True) << 3
            | (now_s < self.veto_until_s) << 4
            | self.is_calibrating << 5
        )

    def arm(self, now_s: float) -> None:
        """Arm by a Command, if nothing speaks against it."""
        vetoes = self.vetoes(now_s)
        if vetoes & 1:
            raise RefusedError(Reason.THROTTLE_NOT_LOW)
        if vetoes & 2:
            raise RefusedError(Reason.RECEIVER_INVALID)
        if vetoes:
            raise RefusedError(Reason.VETO)
        self.is_armed = True

    def disarm(self, now_s: float) -> None:
        """Disarm by a Command; refused unless the throttle has been low for 2 s."""
        since_s = self._throttle_low_since_s
        is_long = since_s is not None and now_s - since_s >= LOW_LONG_ENOUGH_S
        if self.is_armed and self.profile.has_motor and not is_long:
            raise RefusedError(Reason.THROTTLE_NOT_LOW)
        self.is_armed = False

    def ask_mode(self, letter: str, now_s: float) -> None:
        """Take a flight mode from the ground; refused unless the switch stands at AUTO.

        OUTPUT is said for half a second even without an Output, so that a Raspberry Pi that
        waits for it learns that it may begin; another mode ends what OUTPUT was followed.
        """
        self._require_auto()
        self._asked = letter
        self._asked_until_s = now_s + ASKED_LIVES_S
        if letter != OUTPUT:
            self._output_until_s = 0.0
        if letter != SETPOINT:
            self._demand_until_s = 0.0

    def _require_auto(self) -> None:
        if not self.is_auto:
            raise RefusedError(Reason.NOT_AUTO)

    def require_authority(self, mode: str, now_s: float) -> None:
        """Raise ``RefusedError`` unless the Raspberry Pi may fly in this mode now.

        The switch must be at AUTO and no other mode asked for from the ground.
        """
        self._require_auto()
        if self._asked not in (None, mode):
            raise RefusedError(Reason.NOT_AUTO)
        if not self.has_receiver(now_s):
            raise RefusedError(Reason.RECEIVER_INVALID)
        if self.profile.has_motor and not self.is_armed:
            raise RefusedError(Reason.VETO)

    def follow(self, output: Servos, now_s: float) -> None:
        """Follow an Output for 250 ms; throttle 0 leaves the throttle to the stick."""
        self._output = output
        self._output_until_s = now_s + LIVES_S

    def demand_throttle(self, throttle_us: int, lifetime_s: float, now_s: float) -> None:
        """Follow a Setpoint's throttle for its lifetime; 0 leaves it to the stick."""
        self._throttle_demand_us = throttle_us
        self._demand_until_s = now_s + lifetime_s

    def is_output(self, now_s: float) -> bool:
        """Return whether the surfaces follow the Raspberry Pi now."""
        return now_s < self._output_until_s and self.has_receiver(now_s)

    def mode(self, now_s: float) -> str:
        """Return the letter of what happens: OUTPUT, else ACRO (a pass-through)."""
        is_asked = self._asked == OUTPUT and now_s < self._asked_until_s
        return OUTPUT if is_asked or self.is_output(now_s) else ACRO

    def servos(self, now_s: float) -> Servos:
        """Return the pulses for the four servos, us."""
        ailerons, elevator, throttle, rudder = self._receiver.pulses_us[:4]
        if self._receiver.heard_s is None:
            return NEUTRAL
        if self.is_failsafe(now_s):
            ailerons, elevator, rudder = self.profile.preset_us
            throttle = self.profile.throttle_failsafe_us
            if self.age_s(now_s) > THROTTLE_LATCH_S:
                self._is_throttle_latched = True
        elif self.is_output(now_s) and self._output is not None:
            ailerons, elevator, demand_us, rudder = self._output
            throttle = demand_us or throttle
        elif now_s < self._demand_until_s:
            throttle = self._throttle_demand_us or throttle
        if self._is_throttle_latched:
            throttle = self.profile.throttle_failsafe_us
        if self.profile.has_motor and not self.is_armed:
            throttle = DISARMED_THROTTLE_US
        return ailerons, elevator, throttle, rudder
