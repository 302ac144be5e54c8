"""The role of the ground: configuration, and less on a plain public link."""

import pytest

from tests.cogs.mission_control_cog.system import Aircraft
from tests.cogs.mission_control_cog.test_uplink import accepted
from tests.cogs.peers import Server
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.arming_commands import ArmCommand

PUBLIC = "mission_control_cog.modules.mission_control_provider.is_private"


def arm(tmp_path, text):
    """Ask an aircraft to arm; return the answer and whether an arming Command was published."""

    async def fly():
        server = Server(reactor)
        port = await server.open()
        async with Aircraft(tmp_path, port, text) as a:
            a.listen_to(ArmCommand)
            peer = await accepted(server)
            (frame, *_) = await until(lambda: peer.named("up.telemetry.update"))
            peer.say({"name": "up.arm", "id": "a", "beacon": frame["beacon"]})
            answer = await peer.answer("a")
        await server.close()
        return answer, bool(a.heard)

    return run_in_reactor(fly)


def test_a_pilot_on_a_private_link_arms(tmp_path):
    answer, armed = arm(tmp_path, "role: pilot\n")
    assert (answer["name"], armed) == ("up.ack", True)


@pytest.mark.parametrize("role", ["observer", "operator"])
def test_other_roles_do_not_arm_and_the_refusal_names_the_key(tmp_path, role):
    answer, armed = arm(tmp_path, f"role: {role}\n")
    assert not armed
    assert answer["data"]["code"] == "forbidden"
    assert "(mission_control.yml: role)" in answer["data"]["reason"]


def test_a_pilot_on_a_plain_public_link_is_an_operator(tmp_path, monkeypatch):
    monkeypatch.setattr(PUBLIC, lambda host: False)
    answer, armed = arm(tmp_path, "role: pilot\n")
    assert not armed
    assert answer["data"]["code"] == "forbidden"
    assert "(mission_control.yml: i_accept_plain)" in answer["data"]["reason"]


def test_a_pilot_on_a_plain_public_link_that_was_accepted_arms(tmp_path, monkeypatch):
    monkeypatch.setattr(PUBLIC, lambda host: False)
    answer, armed = arm(tmp_path, "role: pilot\ni_accept_plain: true\n")
    assert (answer["name"], armed) == ("up.ack", True)


def test_the_role_is_checked_at_every_connection(tmp_path, monkeypatch):
    async def fly():
        server = Server(reactor)
        port = await server.open()
        async with Aircraft(tmp_path, port, "role: pilot\n") as a:
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

    run_in_reactor(fly)


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
        async with Aircraft(tmp_path, port, text + "tune_in_flight: true\n"):
            peer = await accepted(server)
            (frame, *_) = await until(lambda: peer.named("up.telemetry.update"))
        await server.close()
        return frame["data"]["ground"]

    assert run_in_reactor(fly) == {"role": role, "tune_in_flight": True}
