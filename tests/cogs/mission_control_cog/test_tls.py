"""The aircraft's links by TLS: a protected pilot, no plain attempt, and its own listener."""

import os
import socket

import pytest
from mission_control_cog.modules.ground_listener import GroundListener
from twisted.logger import globalLogPublisher

from tests.cogs.mission_control_cog.hostile_relay import Ground
from tests.cogs.mission_control_cog.system import Aircraft, listening
from tests.cogs.mission_control_cog.test_role import PUBLIC
from tests.cogs.mission_control_cog.test_uplink import accepted
from tests.cogs.peers import Server, TLSServer, connect
from tests.support.certificates import Certificates
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.arming_commands import ArmCommand
from up.tls.files import TLSFiles


def settings(port, folder):
    # Relative to the folder of mission_control.yml.
    server = f"remote_server: {{url: 127.0.0.1, port: {port}, tls: {folder}, security: accept}}\n"
    return f"{server}aircraft: glider-1\nrole: pilot\n"


async def test_a_pilot_on_a_public_address_may_arm_by_tls_and_data_flow(tmp_path, monkeypatch):
    own = Certificates(tmp_path)
    own.client()
    monkeypatch.setattr(PUBLIC, lambda host: False)
    server = TLSServer(reactor, TLSFiles(own.server()))
    port = await server.open()
    folder = os.path.relpath(own.authority.folder / "glider-1", tmp_path)
    async with Aircraft(tmp_path, None, settings(port, folder)) as a:
        a.listen_to(ArmCommand)
        peer = await accepted(server)
        assert peer.transport.peer_name == "glider-1"
        (frame, *_) = await until(lambda: peer.named("up.telemetry.update"))
        peer.say({"name": "up.arm", "id": "a", "beacon": frame["beacon"]})
        assert (await peer.answer("a"))["name"] == "up.ack"
        assert len(a.heard) == 1
        link = a.provider._uplink._link.transport
        option = link.getHandle().getsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT)
        assert option == 1500
        # The data budget counts what TLS adds: here the certificates of both sides.
        assert a.provider._uplink._link.ip_bytes() > 2000 + len(peer.received)
        peer.transport.abortConnection()
        await accepted(server, 1)
    await server.close()


def test_an_untrusted_or_plain_proxy_gets_no_line_and_the_log_a_code(tmp_path):
    own = Certificates(tmp_path)
    folder = own.client()

    async def fly(server, code):
        port = await server.open()
        events = []
        globalLogPublisher.addObserver(events.append)
        async with Aircraft(tmp_path, None, settings(port, folder)) as a:
            if isinstance(server, TLSServer):
                await until(lambda: code in [each.get("code") for each in events])
                assert server.peers == []
            else:
                peer = await server.peer()
                await until(lambda: peer.received)
                peer.say(b"UP1 ok aircraft=glider-1 seat=air token=" + b"ab" * 16 + b"\n")
                await until(lambda: code in [each.get("code") for each in events])
                assert all(b"UP1" not in each.received for each in server.peers)
            assert not a.provider.connected
        globalLogPublisher.removeObserver(events.append)
        await server.close()

    other = own.of_another_ca("relay", ["127.0.0.1"])
    (other / "revoked.pem").write_bytes((own.authority.folder / "revoked.pem").read_bytes())
    run_in_reactor(fly, TLSServer(reactor, TLSFiles(other)), "tls_unknown_ca")
    run_in_reactor(fly, Server(reactor), "tls_peer_plain")
    (folder / "key.pem").chmod(0o644)
    run_in_reactor(fly, TLSServer(reactor, TLSFiles(other)), "tls_key_mode")


def listener(folder, address="127.0.0.1"):
    return f"listener: {{port: 0, address: '{address}', tls: {folder}}}\nrole: pilot\n"


def test_a_ground_flies_by_tls_directly_and_no_other_peer_is_let_in(tmp_path, monkeypatch):
    """Also one with a public address; the text of a plain peer never reaches the aircraft."""
    own = Certificates(tmp_path)
    laptop = own.client("laptop")
    events = []
    monkeypatch.setattr("up.system.peer_filter.is_private", lambda host: False)
    globalLogPublisher.addObserver(events.append)

    @listening(tmp_path, listener(own.server("glider-1-port")))
    async def _(a):
        a.listen_to(ArmCommand)
        port = a.up.ports["ground"]
        grounds = []
        for folder in (laptop, own.of_another_ca("stranger"), None):
            grounds.append(Ground(tmp_path, port, None, tls=folder))
        pilot, stranger, plain = grounds
        await until(lambda: pilot.telemetry.beacon)
        assert pilot.status.tls_peer == "glider-1-port"
        assert pilot.send(id_="a")
        await until(lambda: pilot.answers("a"))
        peer = await connect(reactor, port)
        peer.say({"name": "up.arm", "id": "b", "beacon": pilot.telemetry.beacon})
        await peer.closed
        for code in ("tls_unknown_ca", "tls_peer_plain"):
            await until(lambda code=code: code in [each.get("code") for each in events])
        assert (len(a.heard), stranger.frames, plain.frames, peer.messages) == (1, 0, 0, [])
        for each in grounds:
            await each.link.stop()

    globalLogPublisher.removeObserver(events.append)


def test_a_faulty_folder_opens_no_port(tmp_path):
    @listening(tmp_path, listener("nowhere"))
    async def _(a):
        assert "ground" not in a.up.ports


@pytest.mark.parametrize(
    ("text", "is_named"),
    [
        ("listener: {port: 0}", True),
        ("listener: {port: 0, tls: certificates/glider-1-port}", False),
        ("listener: {port: 0, security: require}", False),
        ("listener: {port: 0, address: 127.0.0.1}", False),
    ],
)
def test_a_listener_with_tls_is_no_plain_link(tmp_path, text, is_named):
    up = Aircraft(tmp_path, None, text).up
    assert bool(list(up.get_module(GroundListener).plain_links())) is is_named
