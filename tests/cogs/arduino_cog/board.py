"""A small board of the tests' own, written from the protocols page, behind a Rig's port."""

import struct

from arduino_cog.modules.arduino_airspeed import ArduinoAirspeed
from arduino_cog.modules.arduino_forward import (
    ArduinoAltitudeModule,
    ArduinoHeadingModule,
    ArduinoLocationModule,
)
from arduino_cog.modules.arduino_output import ArduinoOutput
from arduino_cog.modules.arduino_panic import ArduinoPanic
from arduino_cog.modules.arduino_profile import ArduinoProfile
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.modules.arduino_requests import (
    ArduinoArming,
    ArduinoCalibration,
    ArduinoFlightMode,
)
from arduino_cog.modules.pid_tunings_provider import PIDTuningsProvider
from serial_cog.modules.serial_provider import SerialProvider

from raspilot.modules.flight_battery import FlightBattery
from tests.cogs.serial_cog.rig import Rig
from up.commands.origin import INTERNAL
from up.protocols.general_message import decode
from up.providers.base_mission_control_provider import BaseMissionControlProvider

MODULES = [
    SerialProvider,
    ArduinoProvider,
    ArduinoArming,
    ArduinoFlightMode,
    ArduinoOutput,
    ArduinoAirspeed,
    ArduinoAltitudeModule,
    ArduinoHeadingModule,
    ArduinoLocationModule,
    ArduinoPanic,
    PIDTuningsProvider,
    ArduinoProfile,
    ArduinoCalibration,
    FlightBattery,
]
STREAMS = "hbBluSAv"
ARMED, AT_AUTO, RECEIVER, IMU, GAINS_STORED = 1, 2, 4, 8, 64
# The rudder has no angle loop.
FACTORY = (*(float(each) for each in range(1, 16)), 0.0, 0.0, 0.0)
PUSHED = "gt"
# The defaults of an Arduino, in the order of the protocols page (2.6).
PROFILE = (
    *(0, 0, 1000, 2000) * 4, 0, 1, b"afA", 5000, 2000, 2500, -300, 2000,
    1000, 900, 1500, 1500, 1500, 0,
)  # fmt: skip
PROFILE_FORMAT = ">" + "BhHH" * 4 + "BB3s3h2h2H3HB"


class Ground(BaseMissionControlProvider):
    """Keeps what would go to the ground."""

    def __init__(self, config=None, silent=False):
        super().__init__(config, silent)
        self.sent = []
        self.is_there = True

    def _transmit_data(self, message):
        self.sent.append(decode(message))
        return self.is_there

    def _transmit_newest(self, message):
        pass


class BoardRig(Rig):
    """A system with the Arduino cog, and a board with the answers of ``answers``.

    ``refuse`` maps a type to the reason it is refused for; types in ``mute`` get no answer.
    """

    def __init__(self, folder, framing="checked", config=None, modules=()):
        super().__init__([*MODULES, *modules], folder, framing, config)
        self.gains = list(FACTORY)
        self.profile = struct.pack(PROFILE_FORMAT, *PROFILE)
        self.refuse = {}
        self.mute = set()
        self.flags = AT_AUTO | RECEIVER | IMU | GAINS_STORED
        self.vetoes = 0
        self.uptime_s = 10
        self.switch = 2
        self.battery_mv = 0
        self.mode = b"f"
        self.on_command = self.answer

    @property
    def arduino(self):
        return self.module(ArduinoProvider)

    def two_axes(self):
        return struct.pack(">12f", *self.gains[0:6], *self.gains[9:15])

    def answer(self, command):
        letter = command.type if not isinstance(command, int) else ""
        if letter in self.mute or not letter:
            return
        if letter in self.refuse:
            self.port.send("!", bytes((ord(letter), command.sequence, self.refuse[letter])))
            return
        if letter == "g":
            self.gains[:] = struct.unpack(">18f", command.payload)
        elif letter == "t":
            values = struct.unpack(">12f", command.payload)
            self.gains[0:6], self.gains[9:15] = values[:6], values[6:]
        elif letter == "C":
            self.profile = command.payload
        if letter == "c":
            self.port.send("C", self.profile)
        elif letter == "G":
            self.port.send("G", struct.pack(">18f", *self.gains))
        elif letter == "T":
            self.port.send("T", self.two_axes())
        elif letter not in STREAMS and self.port.framing == "checked":
            self.port.send("K", bytes((ord(letter), command.sequence)))

    def status(self, *, armed=None, uptime_s=None, version=1, vetoes=None, cause=1):
        if armed is not None:
            self.flags = self.flags | ARMED if armed else self.flags & ~ARMED
        if uptime_s is not None:
            self.uptime_s = uptime_s
        if vetoes is not None:
            self.vetoes = vetoes
        self.say(
            "x",
            struct.pack(
                ">BcBBBBHHHHHHHHB",
                version, self.mode, self.switch, self.flags, self.vetoes, cause,
                2000, 48, 3, 1, self.uptime_s, 12, 4, self.battery_mv, 0,
            ),
        )  # fmt: skip

    def start_alone(self):
        """Start before any board is there: the port is open and silent."""
        self.on_command = lambda command: None
        self.start()
        self.on_command = self.answer

    def connect(self, *, armed=False):
        """Start, with the board's first messages."""
        self.start()
        self.status(armed=armed)

    def sent(self, letters):
        """Return the payloads of those types that came since the last call of ``forget``."""
        found = [each for each in self.port.heard if not isinstance(each, int)]
        return [each.payload for each in found if each.type in letters]

    def forget(self):
        self.port.heard.clear()

    def publish(self, command, **origin):
        self.up.command_executor.execute_command(command, **origin)
        self.turn()

    def ask(self, command):
        """Publish a Command and return a list that its outcome, or its failure, comes into."""
        outcome = []
        done = self.up.command_executor.execute_and_wait(command, INTERNAL)
        done.addCallbacks(lambda _: outcome.append("done"), lambda fail: outcome.append(fail.value))
        self.turn()
        self.reactor.advance(0)
        return outcome

    def throttle(self, pulse_us):
        self.say("r", struct.pack(">4H", 1500, 1500, pulse_us, 1500))

    def alive(self, seconds=1.0, **status):
        """Advance the time on a board that sends its status five times a second."""
        for _ in range(round(seconds / 0.2)):
            self.advance(0.2)
            self.status(**status)

    def heard_on_bus(self, command):
        taken = []

        def take(each):
            taken.append((each, self.up.command_executor.origin))

        self.up.command_executor.register_command(command, take)
        return taken
