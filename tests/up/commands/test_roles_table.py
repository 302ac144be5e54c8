"""Every Command and every role, as in the protocols page."""

import re
from pathlib import Path

import pytest
from android_cog.commands.android_battery_command import (
    AndroidBatteryCommand,
    AndroidBatteryLowCommand,
)
from android_cog.commands.android_speak_command import AndroidSpeakCommand
from arduino_cog.commands.arduino_calibrate_command import ArduinoCalibrateCommand
from arduino_cog.commands.arduino_profile_commands import (
    ArduinoProfileRequestCommand,
    ArduinoProfileValuesCommand,
)
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from black_box_cog.commands.mark_command import MarkCommand
from black_box_cog.commands.record_command import RecordCommand

from tests.up.commands.samples import Border
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import wire_fields
from up.commands.command_registry import CommandRegistry
from up.commands.origin import INTERNAL
from up.commands.roles import Role

ROOT = Path(__file__).parents[3]
COGS = (
    AndroidBatteryCommand,
    AndroidBatteryLowCommand,
    AndroidSpeakCommand,
    ArduinoCalibrateCommand,
    ArduinoProfileRequestCommand,
    ArduinoProfileValuesCommand,
    ArduinoStatusCommand,
    MarkCommand,
    RecordCommand,
)
REGISTRY = CommandRegistry((*BUILTIN_COMMANDS, *COGS))
NOBODY = "\N{EN DASH}"
LADDER = ("observer", "operator", "pilot", "admin")
GAINS = {axis: {"p": 1, "i": 0, "d": 0} for axis in ("ailerons", "elevator")}
STICKS = {name: 1500 for name in ("ailerons", "elevator", "throttle", "rudder")}
SAMPLES = {
    "up.telemetry.update": {"content": {}, "beacon": 1},
    "up.telemetry.frequency": {"frequency": 100},
    "up.location.update": {"latitude": 1, "longitude": 2},
    "up.altitude.change": {"altitude": 1},
    "up.heading.change": {"heading": 1, "mode": "actual"},
    "up.orientation.update": {"roll": 1, "pitch": 2, "yaw": 3},
    "up.rx.update": {**STICKS, "aux1": 1500, "aux2": 1500, "valid": 63},
    "up.servo.update": STICKS,
    "up.output.set": {**STICKS, "sequence": 1},
    "up.setpoint.set": {"roll": 1, "pitch": 1},
    "up.flight_mode.set": {"mode": "FBW"},
    "up.flight.state": {"flight_mode": "FBW", "armed": True, "auto": True, "failsafe": False},
    "up.flight.limits": {},
    "up.panic": {"panic": True, "delay_ms": 100},
    "up.system.state": {
        "utilization": 1, "memory": 1, "providers": [], "arduino_connected": True, "mode": "auto"
    },
    "up.link.state": {"link": "arduino", "connected": True},
    "up.source.selected": {"reading": "location", "source": "android"},
    "up.ack": {"id": "a"},
    "up.nack": {"id": "a", "code": "refused"},
    "up.command.answered": {"link": "ground", "name": "up.arm"},
    "up.arm": {},
    "up.disarm": {},
    "up.system.stop": {},
    "arduino.status": dict.fromkeys(
        (key for _, key, _ in wire_fields(ArduinoStatusCommand)), 1
    ),
    "android.battery": {"level": 5},
    "android.battery.low": {"level": 5, "low": True},
    "android.speak": {"text": "hello"},
    "arduino.calibrate": {"what": "level"},
    "black_box.mark": {"text": "thermal"},
    "black_box.record": {"topic": "pitot.air", "content": {}},
    "arduino.profile.request": {},
    "arduino.profile.values": {"profile": {}},
    "arduino.pids.tunings": {"pids": {"ratePIDs": GAINS, "stabPIDs": GAINS}},
    "arduino.pids.values": {"pids": {"ratePIDs": GAINS, "stabPIDs": GAINS}},
}  # fmt: skip


def rows():
    """Return (names, role) of every line of the page's table of Commands."""
    page = (ROOT / "docs" / "protocols.md").read_text(encoding="utf-8")
    section = page.split("\n## 5 ")[1].split("\n## 6 ")[0]
    found = []
    for line in section.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("| `") and len(cells) == 4:
            found.append((re.findall(r"`([^`]+)`", cells[0]), cells[2]))
    return found


def allowed(words):
    """Return the roles that a cell means: those that it names, and those that include them."""
    if words == "any":
        return set(Role)
    if words == NOBODY:
        return set()
    found = {Role.INTERNAL}
    for word in re.findall(r"[a-z]+", words.removesuffix(", with a beacon")):
        found.add(Role(word))
        if word in LADDER:
            found.update(Role(each) for each in LADDER[LADDER.index(word) :])
        if word == "observer":
            found.add(Role.SENSOR)
    return found


def cases():
    """Return (name, data, the roles that may) for every Command and every variant of it."""
    found = []
    for names, words in rows():
        plain, _, special = words.partition("; ")
        for name in names:
            sample = SAMPLES[REGISTRY.primary_name(name)]
            found.append((name, sample, allowed(plain)))
            if special.startswith("`mode` `required`: "):
                found.append((name, {**sample, "mode": "required"}, allowed(special.split()[-1])))
            elif special.startswith("`request`: "):
                found.append((name, {"request": True}, allowed(special.split()[-1])))
            else:
                assert not special
    return found


def test_the_page_and_the_program_know_the_same_commands():
    on_page = {name for names, _ in rows() for name in names}
    ours = {name for cls in REGISTRY for name in (cls.NAME, *cls.ALIASES)}
    assert on_page == ours


@pytest.mark.parametrize("role", Role)
@pytest.mark.parametrize(("name", "data", "roles"), cases())
def test_who_may_send_what(name, data, roles, role):
    border = Border(role, *COGS)
    heard = []

    def hear(command):
        # The receiver's own publications about this Command do not come from outside.
        if border.bus.origin is not INTERNAL:
            heard.append(command)

    border.bus.register_command(name, hear)
    border.receiver.register_route("android", lambda command, link, id_: heard.append(command))
    border.say(name, data, "a", border.beacons.draw())
    assert bool(heard) == (role in roles), border.answers
    if not heard:
        assert border.codes == ["forbidden"]
