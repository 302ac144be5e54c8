"""The aircraft's link by TLS: a protected pilot, and no plain attempt."""

import os
import socket

from twisted.logger import globalLogPublisher

from tests.cogs.mission_control_cog.system import Aircraft
from tests.cogs.mission_control_cog.test_role import PUBLIC
from tests.cogs.mission_control_cog.test_uplink import accepted
from tests.cogs.peers import Server, TLSServer
from tests.support.certificates import Certificates
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.arming_commands import ArmCommand
from up.tls.files import TLSFiles


def settings(port, folder):
    # Relative to the folder of mission_control.yml.
    server = f"remote_server: {{url: 127.0.0.1, port: {port}, tls: {folder}, security: accept}}\n"
    return f"{server}aircraft: glider-1\nrole: pilot\n"


def test_a_pilot_on_a_public_address_may_arm_by_tls_and_data_flow(tmp_path, monkeypatch):
    own = Certificates(tmp_path)
    own.client()
    monkeypatch.setattr(PUBLIC, lambda host: False)

    async def fly():
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

    run_in_reactor(fly)


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
