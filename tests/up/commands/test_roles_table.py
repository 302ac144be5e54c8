import pytest
from android_cog.commands.android_commands import (
    AndroidBatteryCommand,
    AndroidBatteryLowCommand,
    AndroidSpeakCommand,
)
from arduino_cog.commands.arduino_commands import (
    ArduinoCalibrateCommand,
    ArduinoProfileRequestCommand,
    ArduinoProfileValuesCommand,
    BatteryCalibrateCommand,
)
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from black_box_cog.commands.black_box_commands import MarkCommand, RecordCommand

from tests.up.commands.samples import Border
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import wire_fields
from up.commands.command_registry import CommandRegistry
from up.commands.origin import INTERNAL
from up.commands.roles import Role

COGS = (
    AndroidBatteryCommand,
    AndroidBatteryLowCommand,
    AndroidSpeakCommand,
    ArduinoCalibrateCommand,
    ArduinoProfileRequestCommand,
    ArduinoProfileValuesCommand,
    ArduinoStatusCommand,
    BatteryCalibrateCommand,
    MarkCommand,
    RecordCommand,
)
REGISTRY = CommandRegistry((*BUILTIN_COMMANDS, *COGS))
LADDER = ("observer", "operator", "pilot", "admin")
WHO = {
    "observer": (
        "arduino.profile.request", "up.ack", "up.mission.request", "up.nack",
        "up.parameter.request",
    ),
    "operator": (
        "android.speak", "black_box.mark", "up.flight_mode.set", "up.home.set",
        "up.mission.commit", "up.mission.item", "up.mission.part", "up.navigation.target",
        "up.telemetry.frequency",
    ),
    "pilot": (
        "arduino.calibrate", "arduino.pids.tunings", "up.arm", "up.battery.calibrate", "up.disarm",
        "up.parameter.set",
    ),
    "sensor": (
        "android.battery", "black_box.record", "up.airspeed.update", "up.altitude.change",
        "up.flight_battery.update", "up.heading.change",
        "up.location.change", "up.location.update", "up.orientation.update",
    ),
    "board": (
        "arduino.status", "up.acceleration.update", "up.ack", "up.flight.state",
        "up.flight_battery.update", "up.nack",
        "up.orientation.update", "up.rx.update", "up.servo.update",
    ),
}  # fmt: skip
"""Who may send which Command from outside, beside those that include the role."""
SPECIAL = (
    ("up.altitude.change", {"mode": "required"}, "operator"),
    ("up.heading.change", {"mode": "required"}, "operator"),
    ("arduino.pids.tunings", {"request": True}, "observer"),
)
GAINS = {axis: {"p": 1, "i": 0, "d": 0} for axis in ("ailerons", "elevator")}
STICKS = {name: 1500 for name in ("ailerons", "elevator", "throttle", "rudder")}
SAMPLES = {
    "up.telemetry.update": {"content": {}, "beacon": 1},
    "up.telemetry.frequency": {"frequency": 100},
    "up.location.update": {"latitude": 1, "longitude": 2},
    "up.airspeed.update": {"airspeed": 11},
    "up.altitude.change": {"altitude": 1},
    "up.heading.change": {"heading": 1, "mode": "actual"},
    "up.acceleration.update": {"forward": 1},
    "up.orientation.update": {"roll": 1, "pitch": 2, "yaw": 3},
    "up.rx.update": {**STICKS, "aux1": 1500, "aux2": 1500, "valid": 63},
    "up.servo.update": STICKS,
    "up.output.set": {**STICKS, "sequence": 1},
    "up.setpoint.set": {"roll": 1, "pitch": 1},
    "up.flight_mode.set": {"mode": "FBW"},
    "up.home.set": {},
    "up.navigation.target": {"latitude": 1, "longitude": 2},
    "up.mission.part": {"plan": "mission", "plan_id": "0", "count": 1},
    "up.mission.commit": {"plan": "mission", "plan_id": "0", "count": 1},
    "up.mission.request": {"plan": "fence"},
    "up.mission.item": {"item": 1},
    "up.mission.problems": {"plan": "mission", "plan_id": "0", "problems": []},
    "up.flight.state": {"flight_mode": "FBW", "armed": True, "auto": True, "failsafe": False},
    "up.flight.limits": {},
    "up.flight_battery.update": {"voltage": 11.1},
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
    "up.parameter.request": {},
    "up.parameter.set": {"file": "loiter.yml", "key": "radius_m", "value": "60"},
    "up.parameter.values": {"file": "loiter.yml", "values": {"radius_m": 60}, "next_start": {}},
    "arduino.status": dict.fromkeys(
        (key for _, key, _ in wire_fields(ArduinoStatusCommand)), 1
    ),
    "android.battery": {"level": 5},
    "android.battery.low": {"level": 5, "low": True},
    "android.speak": {"text": "hello"},
    "arduino.calibrate": {"what": "level"},
    "up.battery.calibrate": {"voltage": 12.6},
    "black_box.mark": {"text": "thermal"},
    "black_box.record": {"topic": "pitot.air", "content": {}},
    "arduino.profile.request": {},
    "arduino.profile.values": {"profile": {}},
    "arduino.pids.tunings": {"pids": {"ratePIDs": GAINS, "stabPIDs": GAINS}},
    "arduino.pids.values": {"pids": {"ratePIDs": GAINS, "stabPIDs": GAINS}},
}  # fmt: skip


def allowed(*words):
    """Return the roles that may: the named ones, and those that include them."""
    found = {Role(word) for word in words}
    for word in words:
        if word in LADDER:
            found.update(Role(each) for each in LADDER[LADDER.index(word) :])
        if word == "observer":
            found.add(Role.SENSOR)
    return found | {Role.INTERNAL} if found else found


def cases():
    """Yield (name, data, the roles that may) for every Command and every variant of it."""
    for cls in REGISTRY:
        for name in (cls.NAME, *cls.ALIASES):
            words = [word for word, names in WHO.items() if name in names]
            yield name, SAMPLES[cls.NAME], allowed(*words)
    for name, data, word in SPECIAL:
        yield name, {**SAMPLES[name], **data}, allowed(word)


@pytest.mark.parametrize("role", Role)
@pytest.mark.parametrize(("name", "data", "roles"), list(cases()))
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
