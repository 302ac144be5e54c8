"""Clients of a TLS server, each with one thing wrong; real sockets in one reactor."""

import ssl
import warnings

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.endpoints import TCP4ClientEndpoint
from twisted.internet.protocol import Factory

from tests.cogs.peers import Peer, Server, TLSServer, connect
from tests.support.certificates import Certificates
from tests.support.reactor import reactor, run_in_reactor, until
from up.tls import protocol
from up.tls.errors import TLSError
from up.tls.files import TLSFiles
from up.tls.protocol import TLSClientEndpoint
from up.version import BUILT_S


@pytest.fixture(scope="module")
def certificates(tmp_path_factory):
    found = Certificates(tmp_path_factory.mktemp("certificates"))
    found.server()
    found.client()
    return found


async def connect_tls(port, folder, host="127.0.0.1", seconds=None):
    files = TLSFiles(folder) if seconds is None else TLSFiles(folder, seconds)
    factory = Factory.forProtocol(Peer)
    factory.noisy = False
    tcp = TCP4ClientEndpoint(reactor, "127.0.0.1", port)
    return await TLSClientEndpoint(reactor, tcp, files, host).connect(factory)


def run(server, scenario):
    async def whole():
        port = await server.open()
        try:
            return await scenario(port)
        finally:
            await server.close()
            await until(lambda: not server.factory._pending)

    return run_in_reactor(whole)


def outcome(server_folder, client_folder, host="127.0.0.1", seconds=None, make=TLSFiles):
    """Return the client's code; "" if the server answered."""
    server = TLSServer(reactor, make(server_folder))

    async def scenario(port):
        try:
            peer = await connect_tls(port, client_folder, host, seconds)
        except TLSError as error:
            assert server.peers == []
            return error.code
        peer.say(b"hello\n")
        await until(lambda: not peer.is_open or (server.peers and server.peers[0].received))
        is_answered = bool(server.peers)
        await peer.close()
        return "" if is_answered else "refused_later"

    return run(server, scenario)


def test_both_sides_know_each_other_and_data_pass(certificates):
    server = TLSServer(reactor, TLSFiles(certificates.authority.folder / "relay"))

    async def scenario(port):
        peer = await connect_tls(port, certificates.authority.folder / "glider-1")
        other = await server.peer()
        assert (peer.transport.peer_name, other.transport.peer_name) == ("relay", "glider-1")
        peer.say(b"x" * 300_000, b"\n")
        await until(lambda: len(other.received) == 300_001)
        other.say(b"y" * 300_000)
        other.transport.loseConnection()
        await until(lambda: not peer.is_open)
        assert peer.received == b"y" * 300_000
        assert peer.transport.error is None

    run(server, scenario)


@pytest.mark.parametrize(
    ("server", "host", "code"),
    [
        (lambda c: c.of_another_ca("relay", ["127.0.0.1"]), "127.0.0.1", "tls_unknown_ca"),
        (lambda c: c.self_signed(), "127.0.0.1", "tls_unknown_ca"),
        (lambda c: c.server("old", days=0), "127.0.0.1", "tls_expired"),
        (lambda c: c.of_tomorrow("new", ["127.0.0.1"]), "127.0.0.1", "tls_not_yet_valid"),
        (lambda c: c.authority.folder / "relay", "relay.example", "tls_wrong_name"),
        (lambda c: c.authority.folder / "relay", "127.0.0.2", "tls_wrong_name"),
        (lambda c: c.authority.folder / "glider-1", "127.0.0.1", "tls_wrong_purpose"),
    ],
)
def test_a_client_refuses_a_server_and_names_the_cause(tmp_path, server, host, code):
    own = Certificates(tmp_path)
    own.server()
    client = own.client()
    folder = server(own)
    (folder / "revoked.pem").write_bytes((own.authority.folder / "revoked.pem").read_bytes())
    assert outcome(folder, client, host) == code


def test_a_client_refuses_a_revoked_server(tmp_path):
    own = Certificates(tmp_path)
    own.server()
    client = own.client()
    own.authority.revoke("relay")
    assert outcome(own.authority.folder / "relay", client) == "tls_revoked"


def test_a_server_refuses_a_revoked_client_without_a_restart(tmp_path):
    own = Certificates(tmp_path)
    server = TLSServer(reactor, TLSFiles(own.server()))
    client = own.client()

    async def scenario(port):
        first = await connect_tls(port, client)
        await server.peer()
        own.authority.revoke("glider-1")
        second = await connect_tls(port, client)
        await until(lambda: not second.is_open)
        assert second.transport.error.code == "tls_revoked"
        assert len(server.peers) == 1
        await first.close()

    run(server, scenario)


def test_before_the_clock_is_set_dates_are_not_checked_but_the_ca_is(tmp_path):
    own = Certificates(tmp_path)
    expired, client = own.server(days=0), own.client()
    early = lambda: BUILT_S - 1.0  # noqa: E731
    assert outcome(expired, client, seconds=lambda: BUILT_S + 1.0) == "tls_expired"
    assert outcome(expired, client, seconds=early) == ""
    other = own.of_another_ca("relay", ["127.0.0.1"])
    (other / "revoked.pem").write_bytes((own.authority.folder / "revoked.pem").read_bytes())
    assert outcome(other, client, seconds=early) == "tls_unknown_ca"
    assert outcome(expired, client, "relay.example", seconds=early) == "tls_wrong_name"


class OldFiles(TLSFiles):
    """A server of ten years ago."""

    def server(self, *, clients=True):
        context = super().server(clients=clients)
        context.set_ciphers("ALL:@SECLEVEL=0")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            context.minimum_version = ssl.TLSVersion.TLSv1
            context.maximum_version = ssl.TLSVersion.TLSv1_1
        return context


def test_a_client_refuses_a_server_of_an_old_version(certificates):
    folder = certificates.authority.folder
    assert outcome(folder / "relay", folder / "glider-1", make=OldFiles) == "tls_too_old"


def test_a_client_never_speaks_plain(certificates):
    async def scenario():
        server = Server(reactor)
        port = await server.open()
        making = connect_tls(port, certificates.authority.folder / "glider-1")
        attempt = Deferred.fromCoroutine(making)
        peer = await server.peer()
        await until(lambda: peer.received)
        peer.say(b"UP1 ok aircraft=a seat=air token=" + b"ab" * 16 + b"\n")
        with pytest.raises(TLSError) as caught:
            await attempt
        await until(lambda: not peer.is_open)
        sent = peer.received
        await server.close()
        return caught.value.code, sent

    code, sent = run_in_reactor(scenario)
    assert code == "tls_peer_plain"
    assert sent.startswith(b"\x16\x03")


def test_a_silent_server_and_a_silent_client_are_given_up(certificates, monkeypatch):
    monkeypatch.setattr(protocol, "HANDSHAKE_LIMIT_S", 0.05)

    async def silent_server():
        server = Server(reactor)
        port = await server.open()
        with pytest.raises(TLSError) as caught:
            await connect_tls(port, certificates.authority.folder / "glider-1")
        await until(lambda: not server.peers[0].is_open)
        await server.close()
        return caught.value.code

    assert run_in_reactor(silent_server) == "tls_timeout"
    server = TLSServer(reactor, TLSFiles(certificates.authority.folder / "relay"))

    async def silent_client(port):
        peer = await connect(reactor, port)
        await until(lambda: not peer.is_open)
        return server.peers

    assert run(server, silent_client) == []


def test_a_server_bounds_its_handshakes(certificates, monkeypatch):
    monkeypatch.setattr(protocol, "MAX_HANDSHAKES", 3)
    server = TLSServer(reactor, TLSFiles(certificates.authority.folder / "relay"))

    async def scenario(port):
        silent = [await connect(reactor, port) for _ in range(5)]
        await until(lambda: sum(each.is_open for each in silent) == 3)
        good = await connect_tls(port, certificates.authority.folder / "glider-1")
        assert not silent[2].is_open
        for each in (*silent, good):
            await each.close()

    run(server, scenario)
