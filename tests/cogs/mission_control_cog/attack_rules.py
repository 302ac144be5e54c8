"""The attacks of a hostile relay, the rule that stops each, and how a test removes that rule.

The table of docs/security.md and the rows of ``python -m bench attacks`` have its words.
"""

import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from mission_control_cog import protection
from mission_control_cog.modules.mission_control_provider import MissionControlProvider

from tests.cogs.mission_control_cog import attacks
from tests.cogs.mission_control_cog.hostile_relay import fly
from tests.support.removed_rules import no_counter, no_direction, no_mac, yes
from up import key_ring
from up.commands.beacon import Beacons
from up.commands.roles import Role
from up.config.keys_file import KeyConfig
from up.protocols import aircraft_sessions, envelope, ground_session
from up.protocols.encrypted_stream import EncryptedStream
from up_ground import telemetry
from up_ground.link_security import LinkSecurity
from up_ground.one_way_delay import OneWayDelayEstimator


@dataclass(frozen=True)
class Attack:
    """``name`` and ``rule`` in words; ``scene``: the arguments of the Scene."""

    name: str
    rule: str
    run: Callable[[Any], Awaitable[tuple[int, int]]]
    remove: Callable[[pytest.MonkeyPatch], object]
    scene: dict[str, str] = field(default_factory=dict)
    now_s: float | None = None
    """The time of the wall clock, in place of the present."""


def attempt(attack: Attack, folder: Path, is_rule_kept: bool = True) -> tuple[int, int]:
    """Return how much the attack achieved, and how often it tried."""
    with pytest.MonkeyPatch.context() as patch:
        if attack.now_s is not None:
            patch.setattr(time, "time", lambda: attack.now_s)
        # The test's reactor counts from 1970, in milliseconds beyond what the ground believes.
        patch.setattr(telemetry, "_MAX_NUMBER", 1e15)
        if not is_rule_kept:
            attack.remove(patch)
        return fly(attack.run, folder, **attack.scene)


def no_age(m):
    m.setattr(Beacons, "is_fresh", yes)


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
        lambda a, name, *more, **named: real(a, "default", *more, **named),
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
        lambda a, name, clock, **more: real(a, name, clock, constant, **more),
    )
    real_ground = ground_session.GroundSession.__init__
    m.setattr(
        ground_session.GroundSession, "__init__", lambda g, *args: real_ground(g, *args, constant)
    )
    m.setattr(Beacons, "was_sent", yes)
    no_age(m)


def no_encryption(m):
    m.setattr(EncryptedStream, "_protect", envelope.Stream._protect)
    m.setattr(EncryptedStream, "_unprotect", envelope.Stream._unprotect)


def secrecy_optional(m):
    """The aircraft takes the hello of a ground that does not encrypt."""
    real = aircraft_sessions.AircraftSessions.__init__
    m.setattr(
        aircraft_sessions.AircraftSessions,
        "__init__",
        lambda a, *args, **_: real(a, *args, secrecy=False),
    )


SECRECY = {"text": "role: pilot\nsecrecy: require\n"}

ATTACKS = (
    Attack("forged Command", "MAC", attacks.forged, no_mac),
    Attack("changed field", "MAC", attacks.changed_field, no_mac),
    Attack("header of one message, payload of another", "MAC", attacks.cut_and_splice, no_mac),
    Attack("replay in the same session", "counters rise", attacks.replay, no_counter),
    Attack(
        "replay in a later session", "counters rise", attacks.replay_in_a_later_session, no_counter
    ),
    Attack(
        "two Commands in the other order (the late one)",
        "counters rise",
        attacks.reorder,
        no_counter,
    ),
    Attack(
        "aircraft's messages sent back to it",
        "direction, and counters",
        attacks.reflect,
        no_direction,
    ),
    Attack("Arm held back for 3 s", "age of the beacon", attacks.hold_back, no_age),
    Attack("envelope stripped", "plain refused", attacks.strip, plain_accepted),
    Attack(
        "plain telemetry to a device with a key",
        "plain refused by the ground",
        attacks.downgrade,
        ground_takes_plain,
    ),
    Attack("relay answers itself", "MAC", attacks.fake_ack, no_mac),
    Attack("old frames repeated", "counters rise", attacks.old_telemetry, no_counter),
    Attack(
        "all frames 3 s late, shown as live",
        "clock of the handshake",
        attacks.late_telemetry,
        no_clock,
    ),
    Attack(
        "another aircraft with the same keys.yml",
        "aircraft in the MAC",
        attacks.wrong_aircraft,
        no_name,
        {"air_name": "other"},
    ),
    Attack("revoked key, device ignores it", "refusal of the key", attacks.revoked, no_refusal),
    Attack(
        "expired key",
        "refusal of the key",
        attacks.expired,
        no_refusal,
        {"not_after": "2020-01-01"},
    ),
    Attack(
        "expired key, clock set back seven years",
        "today is not before the file",
        attacks.expired,
        clock_alone,
        {"not_after": "2020-01-01"},
        1546300800.0,
    ),
    Attack(
        "role raised in the message",
        "role belongs to the key",
        attacks.role_raised,
        role_of_message,
        {"role": "observer"},
    ),
    Attack(
        "observer uses the id of a pilot's Arm first",
        "ids are of one key",
        attacks.id_collision,
        shared_ids,
    ),
    Attack(
        "hello and Arm of the life before, to a restarted aircraft",
        "fresh nonces, and beacons",
        attacks.restarted_aircraft,
        same_random,
    ),
    Attack(
        "answer and frames of the life before, to a restarted ground",
        "fresh nonces",
        attacks.restarted_ground,
        same_random,
    ),
    Attack("relay reads, secrecy required", "encryption", attacks.read, no_encryption, SECRECY),
    Attack(
        "hello for secrecy dropped, the plain one repeated",
        "plain hellos are refused",
        attacks.secrecy_stripped,
        secrecy_optional,
        SECRECY,
    ),
    Attack(
        "one key and nonce in two lives of both sides",
        "fresh nonces",
        attacks.same_keystream,
        same_random,
        SECRECY,
    ),
)
