"""Protected links between a real aircraft and real ground links."""

import json
import sys
from dataclasses import replace

import pytest
from mission_control_cog.config import MISSION_CONTROL, MissionControlConfig, security_of

from tests.cogs.mission_control_cog.attacks import deliver
from tests.cogs.mission_control_cog.hostile_relay import Ground, fly, pair
from tests.cogs.mission_control_cog.system import Aircraft
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.answer_commands import CommandAnsweredCommand
from up.commands.arming_commands import ArmCommand
from up.config import ConfigErrors
from up.config.keys_file import KEYS, revoke_key
from up.protocols.binary_line import HANDSHAKE, PROTECTED
from up.protocols.general_message import decode, encode
from up_ground import link_security
from up_ground.mission_tasks import TransferTask
from up_ground.settings import Seat
from up_ground.token_store import TokenStore

CIPHERS = "cryptography.hazmat.primitives.ciphers.aead"


def plain(s):
    return [decode(line) for line in s.relay.down if line.startswith(b"{")]


async def answer(s, id_):
    (found,) = await until(lambda: s.ground.answers(id_))
    return found.data.get("code", "ack")


def test_a_paired_pilot_arms_on_a_link_that_requires_protection(tmp_path):
    async def body(s):
        await s.ground.ready()
        assert s.ground.send(id_="a")
        assert (await answer(s, "a"), s.armed) == ("ack", 1)
        assert (s.ground.status.security, s.ground.status.key_role) == ("end_to_end", "pilot")
        assert {line[0] for line in s.relay.down} == {PROTECTED, HANDSHAKE}

    fly(body, tmp_path)


def test_required_protection_refuses_plain_commands_and_sends_no_plain_telemetry(tmp_path):
    async def body(s):
        await s.ground.ready()
        line = encode("up.arm", {}, "p", s.ground.telemetry.beacon)[:-1]
        await deliver(s, line, lines=True)
        (nack,) = await until(lambda: plain(s))
        assert (nack.name, nack.data["code"], s.armed) == ("up.nack", "unprotected", 0)

    fly(body, tmp_path)


def test_where_plain_is_accepted_it_has_the_role_of_the_link(tmp_path):
    async def body(s):
        await s.ground.ready()
        (frame, *_) = await until(lambda: plain(s))
        assert frame.data["ground"]["role"] == "operator"
        mode = {"frequency": 100}
        await deliver(s, encode("up.arm", {}, "p", s.ground.telemetry.beacon)[:-1], lines=True)
        await deliver(s, encode("up.telemetry.frequency", mode, "q")[:-1], lines=True)
        found = {m.data["id"]: m.data.get("code") for m in plain(s) if m.name != frame.name}
        assert found == {"p": "forbidden", "q": None}
        s.ground.send(id_="a")
        assert (await answer(s, "a"), s.armed) == ("ack", 1)

    fly(body, tmp_path, text="role: operator\n", security="accept")


def test_a_link_that_is_off_answers_no_hello(tmp_path):
    async def body(s):
        await until(lambda: s.ground.status.unprotected >= 2)
        assert not s.ground.send()
        assert {line[0] for line in s.relay.down} == {b"{"[0]}
        assert s.ground.status.security == "none"

    fly(body, tmp_path, security="off")


def test_every_protected_command_needs_a_beacon(tmp_path):
    async def body(s):
        await s.ground.ready()
        s.ground.link.send(encode("up.telemetry.frequency", {"frequency": 100}, "f"))
        assert await answer(s, "f") == "no_beacon"

    fly(body, tmp_path)


def test_a_plan_is_transferred_in_a_protected_session(tmp_path):
    """Its requests need no beacon on a plain link; the scene's aircraft has no missions."""

    async def body(s):
        await s.ground.ready()
        settings = replace(s.ground.link._settings, seat=Seat.COMMAND)
        await s.ground.link.stop()
        tokens = TokenStore(s.folder, settings)
        task = TransferTask(reactor, settings, tokens, plans={"mission": None})
        task.start()
        await task.finished
        await task.stop()
        return dict(s.aircraft.up.command_receiver.counters)

    counters = fly(body, tmp_path)
    assert counters["received"] > 0
    assert "no_beacon" not in counters


def test_a_command_repeated_in_the_next_session_is_answered_and_not_repeated(tmp_path):
    async def body(s):
        await s.ground.ready()
        beacon = s.ground.telemetry.beacon
        s.ground.send(id_="a")
        assert await answer(s, "a") == "ack"
        await s.ground.link.stop()
        s.ground = Ground(s.folder, s.ground_port, s.pairing)
        await s.ground.ready()
        s.ground.send(id_="a", beacon=beacon)
        assert (await answer(s, "a"), s.armed) == ("ack", 1)

    fly(body, tmp_path)


def test_a_revoked_device_is_told_and_the_others_go_on(tmp_path):
    async def body(s):
        await s.ground.ready()
        revoke_key(s.folder / "air", "tablet")
        await until(lambda: s.ground.status.key_refusal)
        assert s.ground.status.key_refusal == "revoked"
        assert not s.ground.send()
        await s.ground.link.stop()
        s.ground = Ground(s.folder, s.ground_port, pair(s.folder / "air", name="new"))
        await s.ground.ready()

    fly(body, tmp_path)


def test_a_faulty_keys_file_in_flight_keeps_the_keys(tmp_path):
    async def body(s):
        await s.ground.ready()
        stamp = s.aircraft.provider._keys._stamp
        (s.folder / "air" / KEYS.filename).write_text("keys: [", encoding="utf-8")
        await until(lambda: s.aircraft.provider._keys._stamp != stamp)
        s.ground.send(id_="a")
        assert await answer(s, "a") == "ack"
        (s.folder / "air" / KEYS.filename).unlink()
        await until(lambda: s.ground.status.key_refusal)
        assert s.ground.status.key_refusal == "unknown_key"

    fly(body, tmp_path)


def test_the_audit_log_and_the_flight_log_name_key_role_age_and_code(tmp_path):
    path = tmp_path / "audit.jsonl"

    async def body(s):
        # What the flight log gets.
        heard = []
        s.aircraft.up.command_executor.register_command(CommandAnsweredCommand, heard.append)
        await s.ground.ready()
        s.ground.send(id_="a")
        assert await answer(s, "a") == "ack"
        s.ground.send("up.telemetry.frequency", {"frequency": 1}, "f")
        assert await answer(s, "f") == "invalid"
        s.ground.send("up.telemetry.frequency", {"frequency": 100})
        await until(lambda: len(heard) == 4)
        await deliver(s, b"\x02")
        await until(lambda: path.read_text(encoding="utf-8").count("\n") >= 5)
        return s.pairing.secret

    secret = fly(body, tmp_path, text=f"role: observer\naudit_log: {path}\n")
    text = path.read_text(encoding="utf-8")
    lines = [json.loads(line) for line in text.splitlines()]
    found = [(each["name"], each["key"], each["role"], each["code"]) for each in lines]
    assert found == [
        ("session", "tablet", "pilot", ""),
        ("up.arm", "tablet", "pilot", ""),
        ("up.telemetry.frequency", "tablet", "pilot", "invalid"),
        ("up.telemetry.frequency", "tablet", "pilot", ""),
        ("session", "", "observer", "malformed"),
    ]
    assert 0 <= lines[1]["age_ms"] <= 2000
    assert secret not in text


@pytest.mark.parametrize("security", ["accept", "require"])
def test_the_aircrafts_own_listener_has_protected_sessions(tmp_path, security):
    text = f"aircraft: default\nrole: operator\nlistener: {{port: 0, security: {security}}}\n"

    async def run():
        pilot = pair(tmp_path / "air")
        spy = pair(tmp_path / "air", "pilot", "second")
        async with Aircraft(tmp_path / "air", None, text) as a:
            a.listen_to(ArmCommand)
            port = a.up.ports["ground"]
            first = Ground(tmp_path / "1", port, pilot)
            await first.ready()
            second = Ground(tmp_path / "2", port, spy)
            await second.ready()
            first.send(id_="a")
            (one,) = await until(lambda: first.answers("a"))
            second.send(id_="b")
            (two,) = await until(lambda: second.answers("b"))
            for each in (first, second):
                await each.link.stop()
            return one.name, two.data["code"], len(a.heard)

    assert run_in_reactor(run) == ("up.ack", "forbidden", 1)


@pytest.mark.parametrize(
    ("security", "is_public", "more", "expected"),
    [
        ("auto", True, {}, "require"),
        ("auto", True, {"i_accept_plain": True}, "accept"),
        ("auto", False, {}, "accept"),
        ("auto", False, {"i_accept_plain": True, "secrecy": "require"}, "require"),
        ("off", True, {}, "off"),
        ("accept", True, {}, "accept"),
        ("require", False, {"i_accept_plain": True}, "require"),
    ],
)
def test_the_protection_that_a_link_has(security, is_public, more, expected):
    assert security_of(security, is_public, MissionControlConfig(**more)) == expected


def test_secrecy_needs_protection_on_every_link_and_the_package(tmp_path, monkeypatch):
    def codes(text):
        (tmp_path / MISSION_CONTROL.filename).write_text(text)
        try:
            MISSION_CONTROL.load(tmp_path)
        except ConfigErrors as errors:
            return [(each.key, each.code) for each in errors.problems]
        return []

    assert codes("secrecy: require\n") == []
    for link in ("listener", "remote_server"):
        for weak in ("accept", "'off'"):
            text = f"secrecy: require\n{link}: {{security: {weak}}}\n"
            assert codes(text) == [("secrecy", "inconsistent")]
    monkeypatch.setitem(sys.modules, CIPHERS, None)
    assert codes("secrecy: require\n") == [("secrecy", "package_missing")]
    assert codes("secrecy: 'off'\n") == []


@pytest.mark.parametrize("can_encrypt", [True, False])
def test_a_device_encrypts_or_is_refused_with_a_code(tmp_path, monkeypatch, can_encrypt):
    monkeypatch.setattr(link_security, "is_available", lambda: can_encrypt)

    async def fly_and_arm(s):
        if not can_encrypt:
            await until(lambda: s.ground.status.key_refusal)
            assert not s.ground.send(id_="a")
            return s.ground.status.key_fault[1], s.counters["secrecy_required"], s.armed
        await s.ground.ready()
        s.ground.send(id_="a")
        (answer,) = await until(lambda: s.ground.answers("a"))
        return answer.name, s.ground.status.is_secret, s.armed

    expected = ("up.ack", True, 1) if can_encrypt else ("secrecy_required", 1, 0)
    text = "role: pilot\nsecrecy: require\n"
    assert fly(fly_and_arm, tmp_path, text=text) == expected
