"""What a hostile MAVLink client tries; each attack succeeds only without its rule."""

import json

import pytest
from mavlink_cog.config import MAVLINK
from mission_control_cog.modules.mission_control_provider import MissionControlProvider

from tests.mavlink.rig import MAVRig
from up.commands.command_receiver import CommandReceiver
from up.commands.roles import Role
from up.config import ConfigErrors
from up_mavlink.session import Session
from up_mavlink.signing import Signing

KEY, OTHER = bytes(32), bytes(range(32))
ARM, SET_MODE, FORCE = 400, 176, 21196
ACCEPTED, DENIED = 0, 2


def role_too_low(folder):
    rig = MAVRig(folder, role=Role.OPERATOR)
    assert rig.client().command(ARM, 1) == DENIED
    return rig.tuner.armed


def observer_sets_home(folder):
    rig = MAVRig(folder, role=Role.OBSERVER)
    before = rig.manager.home.place
    rig.client().command(179, 1)
    return rig.manager.home.place != before


def arm_despite_a_veto(folder):
    rig = MAVRig(folder)
    rig.up.vetoes.set("test", "a veto")
    assert rig.client().command(ARM, 1, FORCE) == DENIED
    return rig.tuner.armed


def unsigned(folder):
    rig = MAVRig(folder, key=KEY)
    rig.client().command(ARM, 1)
    return rig.tuner.armed


def signed_with_another_key(folder):
    rig = MAVRig(folder, key=KEY)
    rig.client(key=OTHER).command(ARM, 1)
    return rig.tuner.armed


def replayed(folder):
    """A signed packet, sent again on another connection."""
    rig = MAVRig(folder, key=KEY)
    client = rig.client(key=KEY)
    packet = client.pack("command_long", 1, 1, ARM, 0, 1, 0, 0, 0, 0, 0, 0)
    client.session.on_bytes(packet)
    rig.settle()
    assert len(rig.tuner.armed) == 1
    rig.client().session.on_bytes(packet)
    rig.settle()
    return rig.tuner.armed[1:]


def recorded_long_ago(folder):
    rig = MAVRig(folder, key=KEY)
    client = rig.client(key=KEY)
    client.mav.signing.timestamp -= 61 * 100_000
    client.command(ARM, 1)
    return rig.tuner.armed


def another_aircraft(folder):
    rig = MAVRig(folder)
    rig.client().command(ARM, 1, target=2)
    return rig.tuner.armed


def our_own_system_id(folder):
    rig = MAVRig(folder)
    rig.client(system=1).command(ARM, 1)
    return rig.tuner.armed


def another_ground_id(folder):
    rig = MAVRig(folder, ground_id=255)
    rig.client(system=254).command(ARM, 1)
    return rig.tuner.armed


def gains_in_flight(folder):
    rig = MAVRig(folder)
    client = rig.client()
    client.send("param_request_list", 1, 1)
    rig.fly()
    assert client.of("PARAM_VALUE")
    client.send("param_set", 1, 1, b"RATE_RLL_P", 2.5, 9)
    return rig.tuner.gains["ratePIDs"]["ailerons"]["p"] == 2.5


def without_telemetry(folder):
    """A Command after the aircraft has sent no frame for longer than a beacon is valid."""
    rig = MAVRig(folder)
    client = rig.client()
    rig.clock.advance(2.5)
    client.command(ARM, 1)
    return rig.tuner.armed


def no_role(m):
    m.setattr(CommandReceiver, "_forbidden", lambda *_: "")
    m.setattr("up.commands.roles._INCLUDES", dict.fromkeys(Role, frozenset(Role)))


def no_vetoes(m):
    m.setattr("tests.mavlink.rig.Tuner.on_arm", lambda self, command: self.armed.append(command))


def no_signature(m):
    real = Signing.accepts
    m.setattr("hmac.compare_digest", lambda *_: True)
    m.setattr("up_mavlink.codec.Signing.accepts", real)


def all_unsigned(m):
    from up_mavlink import codec

    real = codec._mav

    def plain(dialect, system_id, signing):
        return real(dialect, system_id, None)

    m.setattr(codec, "_mav", plain)


def no_stamp(m):
    m.setattr(Signing, "accepts", lambda *_: True)


def for_all(m):
    m.setattr(Session, "_is_for_us", lambda *_: True)


def no_policy(m):
    m.setattr("mission_control_cog.tuning_policy.TuningPolicy.__call__", lambda self, command: None)


def no_beacon(m):
    m.setattr(CommandReceiver, "_check_beacon", lambda *_: None)


ATTACKS = [
    (role_too_low, no_role),
    (observer_sets_home, no_role),
    (arm_despite_a_veto, no_vetoes),
    (unsigned, all_unsigned),
    (signed_with_another_key, no_signature),
    (replayed, no_stamp),
    (recorded_long_ago, no_stamp),
    (another_aircraft, for_all),
    (our_own_system_id, for_all),
    (another_ground_id, for_all),
    (gains_in_flight, no_policy),
    (without_telemetry, no_beacon),
]


@pytest.mark.parametrize(("attack", "rule"), ATTACKS, ids=lambda each: each.__name__)
def test_an_attack_succeeds_only_without_its_rule(attack, rule, tmp_path, monkeypatch):
    assert not attack(tmp_path / "kept")
    rule(monkeypatch)
    try:
        succeeded = attack(tmp_path / "removed")
    except AssertionError:
        # The answer is not a refusal.
        succeeded = True
    assert succeeded


def test_a_forged_packet_does_not_shut_the_owner_of_the_key_out(tmp_path):
    rig = MAVRig(tmp_path, key=KEY)
    forger = rig.client(key=OTHER)
    forger.mav.signing.timestamp += 10**9
    forger.command(ARM, 1)
    rig.client(key=KEY).command(ARM, 1)
    assert len(rig.tuner.armed) == 1
    assert rig.endpoint.counters["unsigned"] == 1


@pytest.mark.parametrize(
    ("endpoint", "code"),
    [
        ("url: 'udpin:0.0.0.0:14550', role: operator", "unsigned"),
        ("url: 'tcpin::5760', role: pilot", "unsigned"),
        ("url: 'udpout:192.0.2.1:14550', role: pilot", "unsigned"),
        ("url: 'serial:/dev/ttyUSB0:57600', role: operator", "unsigned"),
        ("url: 'udpin:0.0.0.0:14550', signing: require", "value_missing"),
        ("url: 'udp:0.0.0.0:14550'", "bad_format"),
        ("url: 'udpin:example.org:14550'", "bad_format"),
    ],
)
def test_the_configuration_refuses_an_endpoint_that_strangers_could_use(endpoint, code, tmp_path):
    with pytest.raises(ConfigErrors) as caught:
        MAVLINK.parse(f"endpoints: [{{{endpoint}}}]\n", tmp_path / "mavlink.yml")
    assert [each.code for each in caught.value.problems] == [code]


@pytest.mark.parametrize(
    ("endpoint", "role"),
    [
        ("url: 'udpin:0.0.0.0:14550'", Role.OBSERVER),
        ("url: 'serial:/dev/ttyUSB0'", Role.OBSERVER),
        ("url: 'udpin:127.0.0.1:14550'", Role.OPERATOR),
        ("url: 'tcpin:[::1]:5760', role: pilot", Role.PILOT),
        ("url: 'udpin:0.0.0.0:14550', signing: require, key_file: k, role: pilot", Role.PILOT),
    ],
)
def test_the_role_of_an_endpoint(endpoint, role, tmp_path):
    values = MAVLINK.parse(f"endpoints: [{{{endpoint}}}]\n", tmp_path / "mavlink.yml")
    assert values.endpoints[0].granted is role


def test_what_was_tried_is_in_the_audit_log(tmp_path, monkeypatch):
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    rig = MAVRig(tmp_path, role=Role.OPERATOR)
    control = rig.up.get_module(MissionControlProvider)
    control._open_audit()
    control._audit._disk.wait()
    rig.clock.advance(0)
    assert rig.client().command(ARM, 1) == DENIED
    control._audit._disk.wait()
    lines = (tmp_path / "audit.jsonl").read_text(encoding="utf-8").splitlines()
    found = [(each["link"], each["name"], each["code"]) for each in map(json.loads, lines)]
    assert found == [("mavlink", "up.arm", "forbidden")]
