"""A CRSF receiver: channels, link, flight modes, telemetry, faults; what it may not do."""

import pytest
from crsf_cog import frames, mode_channel
from crsf_cog.config import CRSF
from crsf_cog.mode_channel import ModeChannel
from crsf_cog.modules import crsf_receiver
from crsf_cog.modules.crsf_receiver import CrsfReceiver

from tests.cogs.crsf_cog.rig import MODES, CrsfRig, channels_frame, statistics_frame
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.telemetry_commands import TelemetryCommand
from up.config import ConfigErrors
from up.protocols.general_message import GeneralMessage
from up_rig.pty_line import PtyLine

STICKS = "sticks: TAER\n"


@pytest.fixture
def make(tmp_path):
    """Return a maker of rigs."""
    made = []

    def make(config=MODES, **more):
        made.append(CrsfRig(tmp_path / str(len(made)), config, **more))
        return made[-1]

    yield make
    for each in made:
        each.stop()


def test_the_channels_and_the_link_are_in_telemetry(make):
    rig = make()
    assert (rig.content["linked"], rig.content["age_ms"], rig.content["channels"]) == (
        False, None, [],
    )  # fmt: skip
    rig.pulses = {1: 988, 16: 2012}
    rig.advance(0.1)
    content = rig.up.telemetry_controller.collect()["crsf"]
    assert content["channels"] == [988, *[1500] * 14, 2012] and content["age_ms"] == 0
    assert (content["linked"], content["link_quality"], content["rssi_dbm"]) == (True, 100, -70)
    rig.clock.advance(1.5)
    assert rig.content["age_ms"] == 1500 and not rig.content["linked"]
    assert rig.counters == {"channels": 2, "statistics": 2}


def test_the_pilot_selects_flight_modes_by_moving_the_channel(make):
    rig = make()
    rig.advance(0.5)
    before = rig.selected
    rig.pulses[6] = 2012
    rig.advance(0.6)
    assert (rig.selected, rig.counters["selected"]) == ("RETURN", 1)
    rig.pulses[6] = 1500
    rig.advance(0.6)
    assert rig.selected == "RETURN", "an empty name selects nothing"
    rig.pulses[6] = 988
    rig.advance(0.6)
    assert rig.selected == "LOITER" != before
    assert rig.counters["selected"] == 2


def test_a_refused_selection_is_counted_by_its_code_and_not_repeated(make):
    rig = make(MODES.replace("RETURN", "ACRO"))
    rig.advance(0.5)
    rig.pulses[6] = 2012
    before = rig.selected
    rig.advance(1.0)
    assert rig.selected == before and rig.counters["refused_mode_unknown"] == 1


def test_telemetry_reaches_the_transmitter(make):
    rig = make()
    content = {"flight_mode": "FBW", "armed": True, "arduino": {"flight_battery_v": 11.1}}
    rig.bus.execute_command(TelemetryCommand(content, 1))
    assert rig.heard() == {0x08: bytes.fromhex("006F FFFF FFFFFF FF"), 0x21: b"FBW\0"}
    quiet = make("telemetry: false\n")
    quiet.bus.execute_command(TelemetryCommand(content, 1))
    assert quiet.heard() == {}


def test_a_receiver_may_be_absent_unplugged_and_plugged_in_again(make):
    rig = make()
    rig.advance(0.2)
    rig.line.close()
    rig.line = None
    rig.clock.turn()
    rig.clock.advance(3.0)
    rig.line = PtyLine(rig.path)
    rig.clock.advance(2.0)
    rig.send(statistics_frame(50) + channels_frame({1: 1700}))
    assert rig.content["channels"][0] == 1700 and rig.content["link_quality"] == 50


def test_the_sticks_are_in_reserve_of_the_arduinos(make):
    rig = make(STICKS)
    rig.pulses = {1: 1100, 2: 1200, 3: 1300, 4: 1400, 5: 2000, 6: 1000}
    rig.advance(0.2)
    assert rig.rx.reading.source == "crsf"
    channels = {"throttle": 1100, "ailerons": 1200, "elevator": 1300, "rudder": 1400}
    assert rig.rx.get_channels() == {**channels, "aux1": 2000, "aux2": 1000}
    for _ in range(30):
        rig.sticks()
        rig.advance(0.05)
    assert rig.rx.reading.source == "arduino" and rig.rx.reading.valid
    rig.advance(3.0)
    assert rig.rx.reading.source == "crsf"
    rig.quality = 0
    rig.advance(0.1)
    assert rig.rx.fresh(0.25) is None, "a receiver in its failsafe has no valid sticks"


def test_without_a_port_the_module_is_not_loaded():
    module = CrsfReceiver()
    module.bind(type("Context", (), {"config": lambda self, file: file.cls()})())
    assert not module.load()


@pytest.mark.parametrize(
    "text",
    [
        "mode_channel: 6\n",
        "modes: [AUTO, RETURN]\n",
        "mode_channel: 4\nmodes: [AUTO, RETURN]\n",
        "sticks: AAAA\n",
    ],
)
def test_what_cannot_be_meant_is_refused(text):
    with pytest.raises(ConfigErrors):
        CRSF.parse(text, CRSF.filename)


# What the receiver may not do: each of these succeeds only without its rule.


def arm(rig):
    message = GeneralMessage("up.arm", {}, "1", rig.up.beacons.draw())
    rig.up.command_receiver.receive(message, rig.receiver.link)
    return rig.armed


def select_by_a_start_in_flight(rig):
    rig.pulses[6] = 2012
    rig.advance(1.0)
    return rig.selected == "RETURN"


def select_by_the_return_of_the_signal(rig):
    rig.advance(0.5)
    rig.advance(1.0, sends=False)
    rig.pulses[6] = 2012
    rig.advance(1.0)
    return rig.selected == "RETURN"


def select_by_the_receivers_failsafe(rig):
    """In failsafe it sends preset channels and a link quality of 0."""
    rig.advance(0.5)
    rig.pulses[6], rig.quality = 2012, 0
    rig.advance(1.0)
    return rig.selected == "RETURN"


def select_without_link_statistics(rig):
    rig.advance(0.5)
    rig.quality = None
    rig.advance(1.5)
    rig.pulses[6] = 2012
    rig.advance(1.0)
    return rig.selected == "RETURN"


def select_while_moving_past(rig):
    rig.advance(0.5)
    rig.pulses[6] = 2012
    rig.advance(0.2)
    return rig.selected == "RETURN"


def select_by_noise(rig):
    rig.advance(0.5)
    spoilt = channels_frame({6: 2012})[:-1] + channels_frame({6: 1500})[-1:]
    for _ in range(20):
        rig.advance(0.05, sends=False)
        rig.send(statistics_frame(100) + spoilt)
    return rig.selected == "RETURN"


def sticks_above_the_arduinos(rig):
    rig.pulses[1] = 1900
    for _ in range(40):
        rig.sticks(throttle=1400)
        rig.advance(0.05)
    return rig.rx.value.throttle_us == 1900


def all_roles(m):
    m.setattr("up.commands.roles._INCLUDES", dict.fromkeys(Role, frozenset(Role)))


def no_first_position(m):
    real = ModeChannel.update

    def update(self, pulse_us, now_s):
        before = self._position
        mode = real(self, pulse_us, now_s)
        return self._modes[self._position] if self._position not in (before, None) else mode

    m.setattr(ModeChannel, "update", update)


def always_linked(m):
    m.setattr(CrsfReceiver, "is_linked", True)


def statistics_of_any_age(m):
    m.setattr(crsf_receiver, "MAX_STATISTICS_AGE_S", float("inf"))


def at_the_second_frame(m):
    m.setattr(mode_channel, "STEADY_S", 0.0)


def no_checksum(m):
    m.setattr(frames, "crc8", lambda body: 0)


def high_priority(m):
    m.setattr(crsf_receiver, "ORIGIN", Origin("crsf", Role.SENSOR, 20))


ATTACKS = [
    (arm, all_roles),
    (select_by_a_start_in_flight, no_first_position),
    (select_by_the_return_of_the_signal, no_first_position),
    (select_by_the_receivers_failsafe, always_linked),
    (select_without_link_statistics, statistics_of_any_age),
    (select_while_moving_past, at_the_second_frame),
    (select_by_noise, no_checksum),
    (sticks_above_the_arduinos, high_priority),
]


@pytest.mark.parametrize(("attack", "rule"), ATTACKS, ids=lambda each: each.__name__)
def test_an_attack_succeeds_only_without_its_rule(make, attack, rule, monkeypatch):
    assert not attack(make(MODES + STICKS))
    rule(monkeypatch)
    assert attack(make(MODES + STICKS))
