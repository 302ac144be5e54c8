"""Every attack of a hostile relay achieves nothing, and something once its rule is removed."""

import time

import pytest
from mission_control_cog import protection
from mission_control_cog.modules.mission_control_provider import MissionControlProvider

from tests.cogs.mission_control_cog import attacks
from tests.cogs.mission_control_cog.hostile_relay import fly
from up import key_ring
from up.commands.beacon import Beacons
from up.commands.roles import Role
from up.config.keys_file import KeyConfig
from up.protocols import aircraft_sessions, envelope, ground_session, handshake
from up_ground import telemetry
from up_ground.link_security import LinkSecurity
from up_ground.one_way_delay import OneWayDelayEstimator


def _yes(*_):
    return True


def no_mac(m):
    m.setattr(envelope, "is_authentic", _yes)
    m.setattr(handshake, "is_authentic", _yes)


def no_counter(m):
    m.setattr(envelope, "is_newer", _yes)


def no_direction(m):
    """One key for both directions; the counters would still refuse it."""
    real = handshake.SessionKeys.stream
    m.setattr(handshake.SessionKeys, "stream", lambda k, _, number: real(k, b"one", number))
    no_counter(m)


def no_age(m):
    m.setattr(Beacons, "is_fresh", _yes)


def plain_accepted(m):
    m.setattr(
        MissionControlProvider,
        "_on_message",
        lambda p, message: p.up.command_receiver.receive(message, p._link),
    )
    m.setattr(MissionControlProvider, "_grant_role", lambda p, host: None)


def ground_takes_plain(m):
    real = LinkSecurity.open
    m.setattr(LinkSecurity, "open", lambda k, line: line if line[:1] == b"{" else real(k, line))


def no_clock(m):
    m.setattr(OneWayDelayEstimator, "trust", lambda *_: None)


def no_name(m):
    real = aircraft_sessions.AircraftSessions.__init__
    m.setattr(
        aircraft_sessions.AircraftSessions,
        "__init__",
        lambda a, name, *more: real(a, "default", *more),
    )


def no_refusal(m):
    m.setattr(KeyConfig, "refusal", lambda *_: "")


def clock_alone(m):
    """Only the clock decides which day it is, and it is set back."""
    m.setattr(key_ring, "max", lambda *seconds: seconds[-1], raising=False)


def role_of_message(m):
    m.setattr(protection, "Role", lambda _: Role.ADMIN)
    protection.Role.OBSERVER = Role.OBSERVER


def shared_ids(m):
    shared = protection.OrderedDict()
    m.setattr(protection, "OrderedDict", lambda: shared)


def same_random(m):
    """The same nonces and numbers in every life; beacons of the life before count as fresh."""
    constant = lambda size: bytes([7]) * size  # noqa: E731
    real = aircraft_sessions.AircraftSessions.__init__
    m.setattr(
        aircraft_sessions.AircraftSessions,
        "__init__",
        lambda a, name, clock: real(a, name, clock, constant),
    )
    real_ground = ground_session.GroundSession.__init__
    m.setattr(
        ground_session.GroundSession, "__init__", lambda g, *args: real_ground(g, *args, constant)
    )
    m.setattr(Beacons, "was_sent", _yes)
    no_age(m)


ATTACKS = {
    "forged": (no_mac, {}),
    "changed_field": (no_mac, {}),
    "cut_and_splice": (no_mac, {}),
    "replay": (no_counter, {}),
    "replay_in_a_later_session": (no_counter, {}),
    "reorder": (no_counter, {}),
    "reflect": (no_direction, {}),
    "hold_back": (no_age, {}),
    "strip": (plain_accepted, {}),
    "downgrade": (ground_takes_plain, {}),
    "fake_ack": (no_mac, {}),
    "old_telemetry": (no_counter, {}),
    "late_telemetry": (no_clock, {}),
    "wrong_aircraft": (no_name, {"air_name": "other"}),
    "revoked": (no_refusal, {}),
    "expired": (no_refusal, {"not_after": "2020-01-01"}),
    "clock_set_back": (clock_alone, {"not_after": "2020-01-01"}),
    "role_raised": (role_of_message, {"role": "observer"}),
    "id_collision": (shared_ids, {}),
    "restarted_aircraft": (same_random, {}),
    "restarted_ground": (same_random, {}),
}


@pytest.mark.parametrize("rule", ["kept", "removed"])
@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_succeeds_only_without_its_rule(tmp_path, monkeypatch, name, rule):
    remove, scene = ATTACKS[name]
    if name == "clock_set_back":
        # A year before the key's end.
        monkeypatch.setattr(time, "time", lambda: 1546300800.0)
    # The test's reactor counts from 1970, in milliseconds beyond what the ground believes.
    monkeypatch.setattr(telemetry, "_MAX_NUMBER", 1e15)
    if rule == "removed":
        remove(monkeypatch)
    achieved, tries = fly(attacks.__dict__.get(name, attacks.expired), tmp_path, **scene)
    print(f"{name}: {tries} tries, {achieved} accepted with the rule {rule}")
    assert (achieved > 0) == (rule == "removed")
