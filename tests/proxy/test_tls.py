"""The TLS ports of the proxy: who gets in, who does not, and that the others are served."""

import shutil
import socket
import ssl
import struct
import subprocess
from pathlib import Path

import pytest

from tests.proxy.virtual import Bench, HandReactor, Peer
from tests.support.certificates import Certificates
from tests.support.tools import need_tool
from up.tls.files import TLSFiles
from up_proxy.config import ProxyConfig, TLSConfig
from up_proxy.listener import StartError
from up_proxy.poller import Poller
from up_proxy.proxy import Proxy
from up_proxy.send_buffer import SendBuffer
from up_proxy.tls_handshakes import HANDSHAKE_LIMIT_S


@pytest.fixture(scope="module")
def certificates(tmp_path_factory):
    found = Certificates(tmp_path_factory.mktemp("certificates"))
    found.server()
    found.client("glider-1")
    found.client("laptop")
    return found


def device(certificates, name):
    return certificates.authority.folder / name


def bench(certificates, **limits):
    tls = TLSConfig(str(device(certificates, "relay")), 0, 0, plain=True)
    return Bench(tls=tls, **limits)


class TLSPeer(Peer):
    """A client with TLS; `error` is why its handshake or its reading ended."""

    def __init__(self, bench, port, context, data=b"", host="127.0.0.1"):
        super().__init__(bench, port)
        self.error = None
        self.socket = context.wrap_socket(
            self.socket, server_hostname=host, do_handshake_on_connect=False
        )
        self.is_ready = False
        bench.until(self._shake, "a handshake")
        if data and self.is_ready:
            self.say(data)

    def _shake(self):
        try:
            self.socket.do_handshake()
            self.is_ready = True
        except ssl.SSLWantReadError:
            return False
        except OSError as error:
            self.error, self.closed = error, True
        return True

    def say(self, data):
        data = data.encode("ascii") if isinstance(data, str) else data
        while data:
            try:
                data = data[self.socket.send(data) :]
            except ssl.SSLWantWriteError:
                self.bench.pump()
        self.bench.settle()
        return self

    def read(self):
        while self.is_ready and not self.closed:
            try:
                chunk = self.socket.recv(65536)
            except ssl.SSLWantReadError:
                return
            except OSError as error:
                self.error, chunk = error, b""
            self.closed = not chunk
            self.heard += chunk


def context_of(folder):
    return TLSFiles(folder).client()


def failures(bench, side=0):
    return bench.proxy._acceptors[2 + side].tls.failed


def test_a_pair_with_certificates_is_served_as_on_the_plain_ports(certificates):
    with bench(certificates) as b:
        air_port, ground_port = b.proxy.tls_ports
        air = TLSPeer(b, air_port, context_of(device(certificates, "glider-1")))
        air.say("UP1 aircraft=glider-1\n")
        air.expect("UP1 ok aircraft=glider-1 seat=air")
        ground = TLSPeer(b, ground_port, context_of(device(certificates, "laptop")))
        ground.say("UP1 aircraft=glider-1 seat=command\n").expect("seat=command")
        ground.say(b'{"a": 1}\n')
        air.expect(b'{"a": 1}\n')
        plain = b.ground("UP1 aircraft=glider-1 seat=listen\n")
        plain.expect("seat=listen")
        air.say(b'{"b": 2}\n')
        ground.expect(b'{"b": 2}\n')
        plain.expect(b'{"b": 2}\n')
        assert air.socket.version() == "TLSv1.3"


def test_an_aircraft_over_tls_is_told_of_its_watchers(certificates):
    with bench(certificates) as b:
        air_port, _ = b.proxy.tls_ports
        air = TLSPeer(b, air_port, context_of(device(certificates, "glider-1")))
        air.say("UP1 aircraft=glider-1 packed=1\n")
        air.expect("UP1 watch grounds=0 packed=1 attitude=1\n")
        b.ground("UP1 aircraft=glider-1 packed=1\n").expect("seat=command")
        b.pass_time(0.5)
        air.expect("UP1 watch grounds=1 packed=1 attitude=0\n")
        assert not air.closed


def test_a_slow_tls_ground_gets_whole_newest_lines(certificates):
    """What OpenSSL has encrypted already must be repeated exactly, also when lines are dropped."""
    with bench(certificates, queue_bytes=40000) as b:
        air_port, ground_port = b.proxy.tls_ports
        air = TLSPeer(b, air_port, context_of(device(certificates, "glider-1")))
        air.say("UP1 aircraft=glider-1\n").expect("token=")
        ground = TLSPeer(b, ground_port, context_of(device(certificates, "laptop")))
        ground.say("UP1 aircraft=glider-1 seat=command\n").expect("seat=command")
        ground.line()
        ground.is_ready = False  # it reads nothing
        lines = [b'{"n": %d, "x": "%s"}\n' % (n, b"x" * (n % 3000)) for n in range(3000)]
        for start in range(0, len(lines), 10):
            air.say(b"".join(lines[start : start + 10]))
        craft = b.aircraft("glider-1")
        assert craft.dropped_lines > 0
        ground.is_ready = True
        b.until(lambda: lines[-1] in ground.heard, "the newest line")
        assert ground.error is None
        ours = [each for each in ground.heard.split(b"\n")[:-1] if not each.startswith(b"UP1 ")]
        heard = [each + b"\n" for each in ours]
        assert set(heard) <= set(lines)
        assert heard == sorted(heard, key=lines.index)


@pytest.mark.parametrize(
    ("make", "code", "reason"),
    [
        (lambda c: c.self_signed(), "tls_unknown_ca", "UNKNOWN_CA"),
        (lambda c: c.of_another_ca("glider-2"), "tls_unknown_ca", "UNKNOWN_CA"),
        (lambda c: c.client("glider-3", days=0), "tls_expired", "EXPIRED"),
        (lambda c: c.of_tomorrow("glider-4"), "tls_not_yet_valid", "BAD_CERTIFICATE"),
        (lambda c: device(c, "relay"), "tls_wrong_purpose", "UNSUPPORTED_CERTIFICATE"),
    ],
)
def test_a_client_with_a_bad_certificate_is_refused(certificates, tmp_path, make, code, reason):
    folder = Path(shutil.copytree(make(certificates), tmp_path / "device"))
    with bench(certificates) as b:
        context = context_of(folder)
        peer = TLSPeer(b, b.proxy.tls_ports[0], context, "UP1 aircraft=glider-1\n")
        peer.expect_closed()
        assert peer.heard == b""
        assert failures(b) == {code: 1}
        assert reason in str(peer.error).upper().replace(" ", "_")
        assert len(b.proxy._acceptors[2].connections) == 0


def test_a_client_without_a_certificate_is_refused(certificates):
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.load_verify_locations(device(certificates, "laptop") / "ca.pem")
    with bench(certificates) as b:
        peer = TLSPeer(b, b.proxy.tls_ports[1], context, "UP1 aircraft=glider-1\n")
        peer.expect_closed()
        assert (peer.heard, failures(b, 1)) == (b"", {"tls_no_certificate": 1})


def test_an_old_version_is_refused(certificates):
    context = context_of(device(certificates, "laptop"))
    context.set_ciphers("ALL:@SECLEVEL=0")
    with pytest.warns(DeprecationWarning):
        context.minimum_version = ssl.TLSVersion.TLSv1
        context.maximum_version = ssl.TLSVersion.TLSv1_1
    with bench(certificates) as b:
        peer = TLSPeer(b, b.proxy.tls_ports[1], context)
        assert (peer.is_ready, failures(b, 1)) == (False, {"tls_too_old": 1})


def test_a_certificate_revoked_now_ends_its_connection_and_admits_no_other(tmp_path):
    own = Certificates(tmp_path)
    own.server()
    own.client("laptop")
    own.client("tablet")
    with bench(own) as b:
        port = b.proxy.tls_ports[1]
        lost = TLSPeer(b, port, context_of(device(own, "tablet")), "UP1 aircraft=a\n")
        kept = TLSPeer(b, port, context_of(device(own, "laptop")), "UP1 aircraft=a\n")
        for each in (lost, kept):
            each.expect("UP1 ok")
        own.authority.revoke("tablet")
        b.pass_time(0.5)
        lost.expect_closed()
        again = TLSPeer(b, port, context_of(device(own, "tablet")), "UP1 aircraft=a\n")
        again.expect_closed()
        assert failures(b, 1) == {"tls_revoked": 1}
        assert "REVOKED" in str(again.error).upper()
        TLSPeer(b, port, context_of(device(own, "laptop")), "UP1 aircraft=a\n").expect("UP1 ok")
        assert not kept.closed


def test_a_certificate_cannot_be_another_aircraft(certificates):
    with bench(certificates) as b:
        air_port = b.proxy.tls_ports[0]
        for name in ("laptop", "glider-1"):
            context = context_of(device(certificates, name))
            peer = TLSPeer(b, air_port, context, "UP1 aircraft=glider-9\n")
            assert peer.line().startswith("UP1 error code=name ")
        legacy = TLSPeer(b, air_port, context_of(device(certificates, "laptop")), b'{"a": 1}\n')
        legacy.expect_closed()
        assert not b.proxy.registry.aircraft() or not b.aircraft("default").is_online(1000.0)


def test_a_plain_client_on_the_tls_port_gets_a_sentence_and_nothing_else(certificates):
    with bench(certificates) as b:
        peer = Peer(b, b.proxy.tls_ports[0])
        peer.say("UP1 aircraft=glider-1\n")
        assert peer.line().startswith("UP1 error code=malformed ")
        peer.expect_closed()
        assert failures(b) == {"tls_peer_plain": 1}


def test_a_tls_client_on_the_plain_port_fails_immediately(certificates):
    with bench(certificates) as b:
        context = context_of(device(certificates, "glider-1"))
        peer = TLSPeer(b, b.proxy.airborne_port, context)
        assert peer.error.reason == "WRONG_VERSION_NUMBER"
        assert b.proxy._acceptors[0].refused["malformed"] == 1


def test_a_short_client_hello_is_recognised_on_the_plain_port(certificates):
    with bench(certificates) as b:
        peer = b.air("\x16\x03\x01\x00\x40")
        assert peer.line().startswith("UP1 error code=malformed ")


def test_renegotiation_is_refused(certificates):
    need_tool("openssl", "openssl")
    own = device(certificates, "laptop")
    with bench(certificates) as b:
        command = [
            "openssl",
            "s_client",
            "-tls1_2",
            "-connect",
            f"127.0.0.1:{b.proxy.tls_ports[1]}",
        ]
        files = [
            "-CAfile",
            own / "ca.pem",
            "-cert",
            own / "certificate.pem",
            "-key",
            own / "key.pem",
        ]
        asking = subprocess.Popen(
            [*command, *files],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        asking.stdin.write(b"R\n")
        asking.stdin.close()
        b.until(lambda: asking.poll() is not None, "the end of openssl")
        with asking.stdout as said:
            answer = said.read()
    assert b"RENEGOTIATING" in answer
    assert b":no renegotiation:" in answer


def test_half_open_handshakes_are_bounded_and_the_others_served(certificates):
    with bench(certificates, connections=3000, per_address=3000) as b:
        port = b.proxy.tls_ports[1]
        flood = []
        for number in range(1000):
            sock = socket.create_connection(("127.0.0.1", port))
            if number % 2:
                sock.send(b"\x16\x03\x01\x02\x00\x01")
            flood.append(sock)
            if number % 50 == 0:
                b.pump()
        b.settle()
        assert len(b.proxy._acceptors[3].tls) <= 500
        context = context_of(device(certificates, "laptop"))
        TLSPeer(b, port, context, "UP1 aircraft=a\n").expect("UP1 ok")
        b.pass_time(HANDSHAKE_LIMIT_S + 1)
        assert len(b.proxy._acceptors[3].tls) == 0
        assert sum(b.proxy._acceptors[3]._sources.values()) <= 1
        failed = failures(b, 1)
        assert failed["tls_displaced"] >= 500
        assert sum(failed.values()) == 1000
        for sock in flood:
            sock.close()


@pytest.mark.parametrize("lingers", [struct.pack("ii", 0, 0), struct.pack("ii", 1, 0)])
def test_a_probe_that_closes_or_resets_is_no_failed_handshake(certificates, lingers):
    with bench(certificates) as b:
        acceptor = b.proxy._acceptors[2]
        with socket.create_connection(("127.0.0.1", acceptor.port)) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, lingers)
            b.until(lambda: len(acceptor.tls) == 1, "the probe")
        b.until(lambda: len(acceptor.tls) == 0, "its end")
        assert failures(b) == {}
        assert sum(acceptor._sources.values()) == 0


def test_slow_steps_wait_for_their_turn_behind_events():
    order, calls = [], []

    class Reactor:
        def callLater(self, delay_s, call):  # noqa: N802
            calls.append(call)
            return call

    times = iter([0.0, 0.0, 0.02, 0.02, 0.02])
    poller = Poller(Reactor(), lambda: next(times))
    poller.do_later(lambda: order.append("first"))
    poller.do_later(lambda: order.append("second"))
    poller.busy_poll_s = 0.01
    poller.doRead()
    assert order == ["first"] and len(calls) == 1


def test_a_head_that_was_encrypted_is_neither_dropped_nor_divided():
    buffer = SendBuffer(limit_bytes=30)
    buffer.put_rest(b"aaaa\nbbbb\ncccc\n")
    buffer.keep(7)
    buffer.put_control(b"UP1\n")
    buffer.put(b"dddd\neeee\nffff\n")
    assert buffer.head().startswith(b"aaaa\nbbbb\nUP1\n")
    assert buffer.dropped_lines > 0


@pytest.mark.parametrize(
    ("break_it", "code"),
    [
        (lambda folder: (folder / "key.pem").chmod(0o640), "tls_key_mode"),
        (lambda folder: (folder / "certificate.pem").unlink(), "tls_no_file"),
        (lambda folder: (folder / "revoked.pem").write_text("?"), "tls_bad_file"),
    ],
)
def test_a_faulty_folder_stops_the_start(certificates, tmp_path, break_it, code):
    folder = Path(shutil.copytree(device(certificates, "relay"), tmp_path / "relay"))
    break_it(folder)
    config = ProxyConfig(metrics=False, tls=TLSConfig(str(folder), 0, 0))
    with pytest.raises(StartError) as caught:
        Proxy(HandReactor(), config).start()
    assert (caught.value.code, caught.value.status) == (code, 2)
