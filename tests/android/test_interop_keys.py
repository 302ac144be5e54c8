"""The Java ground with a key and by TLS at the real proxy and daemon: pair, watch, command."""

import shutil
import socket
import threading
from itertools import islice

import pytest

from tests.android.console_program import ConsoleProgram
from tests.android.real_daemon import AIRCRAFT, RealDaemon
from tests.android.slow_relay import SlowRelay
from tests.proxy.program import Client, Program
from tests.support.certificates import SERVER, Certificates
from up.config.keys_file import add_key, revoke_key
from up.protocols.binary_line import PACKED, PROTECTED, to_body
from up.protocols.envelope import HEADER_BYTES
from up.protocols.pairing import Pairing

AT = ("--aircraft", AIRCRAFT)


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    made = Certificates(tmp_path_factory.mktemp("certificates"))
    made.server(hosts=("localhost", SERVER))
    made.client("tablet")
    return made


@pytest.fixture(scope="module")
def proxy(tmp_path_factory, own):
    folder = own.authority.folder / "relay"
    text = f"tls: {{folder: {folder}, airborne port: 0, ground port: 0, plain ports: true}}\n"
    with Program(tmp_path_factory.mktemp("proxy"), text) as program:
        program.tls_port("ground")
        yield program


@pytest.fixture
def daemon(tmp_path, proxy):
    made = RealDaemon(tmp_path / "daemon", proxy, security="require")
    yield made
    made.end()


@pytest.fixture(scope="module")
def stranger(proxy):
    """A ground whose options the tests change; the aircraft that it looks for is not there."""
    with ConsoleProgram("--proxy", f"{SERVER}:{proxy.ground_port}", *AT) as program:
        yield program


def pairing_of(daemon, name, role):
    """Return the text of a new key, as `up keys add` prints it."""
    key_id, key = add_key(daemon.folder, name, role)
    return Pairing(AIRCRAFT, key_id, key.secret, role, name).encode()


def test_a_paired_phone_commands_until_its_key_is_revoked(proxy, daemon, own):
    plain = ("--proxy", f"{SERVER}:{proxy.ground_port}", *AT)
    pilot, watcher = pairing_of(daemon, "tablet", "pilot"), pairing_of(daemon, "watch", "observer")
    tls = ("--tls", own.authority.folder / "tablet", "--pairing", pilot)
    daemon.start()
    with (
        SlowRelay(proxy.tls_port("ground")) as relay,
        ConsoleProgram(
            "--proxy", f"localhost:{relay.port}", *AT, *tls, values=["uplink.grounds"]
        ) as console,
        ConsoleProgram(*plain, "--seat", "listen", "--pairing", watcher) as listener,
    ):
        console.holds()
        assert (console.status["role"], console.status["key_fault"]) == ("pilot", "")
        assert (console.status["tls"], listener.status["tls"]) == (True, False)
        console.sees("all grounds", uplink__grounds=2)
        assert console.ask("up.telemetry.frequency", frequency=50)["outcome"] == "ACK"
        # The daemon refuses it: it carries the beacon, and the throttle is not known to be low.
        assert console.ask("up.arm")["outcome"] == "NACK"
        listener.until(lambda: listener.frames, "frames of a listener")
        assert listener.status["role"] == "observer"
        assert console.status["refused"] == listener.status["refused"] == 0
        with Client(proxy.ground_port, f"UP1 aircraft={AIRCRAFT} seat=listen packed=1\n") as other:
            sealed = (to_body(each[:-1]) for each in other.file if each[0] == PROTECTED)
            payloads = [each[1 + HEADER_BYTES] for each in islice(sealed, 40)]
        assert PACKED in payloads, "all grounds read packed telemetry"

        relay.cut(9)
        console.until(lambda: console.status["link"] == "WAITING", "the cut within a record")
        console.holds()
        answer = console.ask("up.telemetry.frequency", frequency=40)
        assert answer["outcome"] == "ACK", answer

        revoke_key(daemon.folder, "tablet")
        console.until(lambda: console.status["key_fault"] == "revoked", "the refusal")
        refused = console.ask("up.telemetry.frequency", frequency=60)
        assert (refused["outcome"], refused["code"]) == ("REFUSED", "revoked")
        last = console.frames[-1]["beacon"]
        listener.until(lambda: listener.frames[-1]["beacon"] > last + 20, "the new streams")
        assert console.frames[-1]["beacon"] == last, "a revoked key reads nothing more"


def refusal(console, port, folder):
    """Return the code with which a connection by TLS ends; OPEN: it was accepted."""
    options = f"--proxy {SERVER}:{port} --tls {folder}"
    notices = len(console.all("notice"))
    console.say(options=options)

    def code():
        taken = [at for at, said in list(console.events) if said.get("text") == options]
        told = console.all("status", taken[-1]) if taken else []
        # A file that the program does not take is an invalid option.
        told += console.all("notice")[notices:]
        ends = ("OPEN" if each.get("link") == "OPEN" else each["code"] for each in told)
        return next((each for each in ends if each.startswith(("tls_", "OPEN"))), None)

    return console.until(code, "a code")


@pytest.mark.parametrize(
    ("code", "make"),
    [
        ("tls_unknown_ca", lambda own: own.of_another_ca("posing", [SERVER])),
        ("tls_wrong_name", lambda own: own.server("elsewhere", ["192.0.2.1", "*.example.org"])),
        ("tls_expired", lambda own: own.server("old", days=0)),
        ("tls_not_yet_valid", lambda own: own.of_tomorrow("early", [SERVER])),
        ("tls_wrong_purpose", lambda own: own.client("thief")),
        ("tls_revoked", lambda own: lost(own)),
    ],
)
def test_a_proxy_with_a_bad_certificate_is_refused(code, make, own, proxy, stranger, tmp_path):
    relay = own.authority.folder / "relay"
    good = shutil.copytree(relay, tmp_path / "good")
    shutil.copytree(own.authority.folder / "tablet", tmp_path / "tablet")
    bad = make(own)
    try:
        for each in ("certificate.pem", "key.pem"):
            shutil.copy(bad / each, relay)
        shutil.copy(own.authority.folder / "revoked.pem", tmp_path / "tablet")
        assert refusal(stranger, proxy.tls_port("ground"), tmp_path / "tablet") == code
    finally:
        for each in ("certificate.pem", "key.pem"):
            shutil.copy(good / each, relay)


@pytest.mark.parametrize(
    ("code", "listed"),
    [
        ("tls_list_expired", lambda own: own.old_list()),
        ("tls_bad_file", lambda own: (own.other.folder / "revoked.pem").read_bytes()),
    ],
)
def test_a_list_that_is_old_or_of_another_ca_trusts_nobody(
    code, listed, own, proxy, stranger, tmp_path
):
    shutil.copytree(own.authority.folder / "tablet", tmp_path / "tablet")
    own.of_another_ca(code, [SERVER])
    (tmp_path / "tablet" / "revoked.pem").write_bytes(listed(own))
    assert refusal(stranger, proxy.tls_port("ground"), tmp_path / "tablet") == code


def lost(own):
    """Return the folder of a proxy whose certificate is revoked."""
    made = own.server("lost")
    own.authority.revoke("lost")
    return made


@pytest.mark.parametrize(
    ("code", "make"),
    [
        ("tls_expired", lambda own: own.client("late", days=0)),
        ("tls_unknown_ca", lambda own: own.of_another_ca("foreign")),
    ],
)
def test_a_proxy_refuses_a_bad_certificate_with_its_reason(code, make, own, proxy, stranger):
    assert refusal(stranger, proxy.tls_port("ground"), make(own)) == code


def test_a_phone_without_a_certificate_is_refused(own, proxy, stranger, tmp_path):
    shutil.copy(own.authority.folder / "ca.pem", tmp_path)
    assert refusal(stranger, proxy.tls_port("ground"), tmp_path) == "tls_no_certificate"


def test_the_plain_port_of_the_proxy_is_refused(own, proxy, stranger):
    folder = own.authority.folder / "tablet"
    assert refusal(stranger, proxy.ground_port, folder) == "tls_peer_plain"


@pytest.mark.parametrize(
    ("code", "answer"),
    [
        ("tls_closed", b"\x16\x03\x03\x00\x7a\x02"),
        ("tls_peer_plain", f"UP1 ok aircraft={AIRCRAFT} seat=command token=t\n".encode()),
    ],
)
def test_a_server_that_ends_within_the_handshake_gets_no_plain_line(code, answer, own, stranger):
    heard = []
    with socket.create_server((SERVER, 0)) as server:

        def serve():
            peer, _ = server.accept()
            with peer:
                heard.append(peer.recv(65536))
                peer.sendall(answer)
                peer.shutdown(socket.SHUT_WR)
                heard.append(peer.recv(65536))

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        port = server.getsockname()[1]
        assert refusal(stranger, port, own.authority.folder / "tablet") == code
        thread.join()
    assert heard[0].startswith(b"\x16\x03")
    assert b"UP1" not in b"".join(heard)
