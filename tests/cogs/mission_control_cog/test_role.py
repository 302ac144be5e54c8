"""The role of the ground: configuration, and less on a plain public link."""

import pytest

from tests.cogs.mission_control_cog.system import Aircraft
from tests.cogs.mission_control_cog.test_uplink import accepted
from tests.cogs.peers import Server
from tests.support.reactor import reactor, run_in_reactor, until
from tests.up.commands.samples import Log
from up.commands.arming_commands import ArmCommand

PUBLIC = "mission_control_cog.modules.mission_control_provider.is_private"


def arm(tmp_path, text):
    """Ask an aircraft to arm; return the answer and whether an arming Command was published."""

    async def fly():
        server = Server(reactor)
        port = await server.open()
        async with Aircraft(tmp_path, port, text, security="accept") as a:
            a.listen_to(ArmCommand)
            peer = await accepted(server)
            (frame, *_) = await until(lambda: peer.named("up.telemetry.update"))
            peer.say({"name": "up.arm", "id": "a", "beacon": frame["beacon"]})
            answer = await peer.answer("a")
        await server.close()
        return answer, bool(a.heard)

    return run_in_reactor(fly)


@pytest.mark.parametrize(
    ("text", "private", "key"),
    [
        ("role: pilot\n", True, None),
        ("role: observer\n", True, "mission_control.yml: role"),
        ("role: operator\n", True, "mission_control.yml: role"),
        ("role: pilot\n", False, "mission_control.yml: i_accept_plain"),
        ("role: pilot\ni_accept_plain: true\n", False, None),
    ],
)
def test_only_a_pilot_arms_and_the_refusal_names_the_key(tmp_path, monkeypatch, text, private, key):
    monkeypatch.setattr(PUBLIC, lambda host: private)
    answer, armed = arm(tmp_path, text)
    assert armed == (key is None)
    if key is None:
        assert answer["name"] == "up.ack"
    else:
        assert answer["data"]["code"] == "forbidden"
        assert f"({key})" in answer["data"]["reason"]


async def test_the_role_is_checked_at_every_connection(tmp_path, monkeypatch):
    server = Server(reactor)
    port = await server.open()
    async with Aircraft(tmp_path, port, "role: pilot\n", security="accept") as a:
        a.listen_to(ArmCommand)
        codes = []
        for index, private in enumerate((False, True, False)):
            monkeypatch.setattr(PUBLIC, lambda host, private=private: private)
            peer = await accepted(server, index)
            (frame, *_) = await until(lambda peer=peer: peer.named("up.telemetry.update"))
            peer.say({"name": "up.arm", "id": f"a{index}", "beacon": frame["beacon"]})
            codes.append((await peer.answer(f"a{index}"))["name"])
            peer.transport.abortConnection()
        assert codes == ["up.nack", "up.ack", "up.nack"]
        assert len(a.heard) == 1
    await server.close()


@pytest.mark.parametrize(
    ("text", "private", "role"),
    [
        ("role: observer\n", True, "observer"),
        ("role: pilot\n", True, "pilot"),
        ("role: pilot\n", False, "operator"),
        ("role: pilot\ni_accept_plain: true\n", False, "pilot"),
    ],
)
def test_telemetry_reports_the_granted_role(tmp_path, monkeypatch, text, private, role):
    monkeypatch.setattr(PUBLIC, lambda host: private)

    async def fly():
        server = Server(reactor)
        port = await server.open()
        tuning = text + "tune_in_flight: true\n"
        async with Aircraft(tmp_path, port, tuning, security="accept"):
            peer = await accepted(server)
            (frame, *_) = await until(lambda: peer.named("up.telemetry.update"))
        await server.close()
        return frame["data"]["ground"]

    assert run_in_reactor(fly) == {"role": role, "tune_in_flight": True}


async def test_a_public_link_without_a_paired_device_is_reported(tmp_path, monkeypatch):
    monkeypatch.setattr(PUBLIC, lambda host: False)
    server = Server(reactor)
    port = await server.open()
    with Log() as log:
        async with Aircraft(tmp_path, port, "role: pilot\n"):
            await accepted(server)
            await until(lambda: [e for e in log.events if e.get("code") == "keys_missing"])
    await server.close()
