"""The Java ground with a key at the real proxy and daemon: pair, watch, command, be revoked."""

from itertools import islice

import pytest

from tests.android.console_program import ConsoleProgram
from tests.android.real_daemon import AIRCRAFT, RealDaemon
from tests.proxy.program import Client, Program
from up.config.keys_file import add_key, revoke_key
from up.protocols.binary_line import PACKED, PROTECTED, to_body
from up.protocols.envelope import HEADER_BYTES
from up.protocols.pairing import Pairing


@pytest.fixture
def proxy(tmp_path):
    with Program(tmp_path / "proxy") as program:
        yield program


@pytest.fixture
def daemon(tmp_path, proxy):
    made = RealDaemon(tmp_path / "daemon", proxy, security="require")
    yield made
    made.end()


def pairing_of(daemon, name, role):
    """Return the text of a new key, as `up keys add` prints it."""
    key_id, key = add_key(daemon.folder, name, role)
    return Pairing(AIRCRAFT, key_id, key.secret, role, name).encode()


def test_a_paired_phone_commands_until_its_key_is_revoked(proxy, daemon):
    at = ("--proxy", f"127.0.0.1:{proxy.ground_port}", "--aircraft", AIRCRAFT)
    pilot, watcher = pairing_of(daemon, "tablet", "pilot"), pairing_of(daemon, "watch", "observer")
    daemon.start()
    with (
        ConsoleProgram(*at, "--pairing", pilot, values=["uplink.grounds"]) as console,
        ConsoleProgram(*at, "--seat", "listen", "--pairing", watcher) as listener,
    ):
        console.holds()
        assert (console.status["role"], console.status["key_fault"]) == ("pilot", "")
        console.sees("all grounds", uplink__grounds=2)
        assert console.ask("up.telemetry.frequency", frequency=50)["outcome"] == "ACK"
        # The daemon refuses it: it carries the beacon, and the throttle is not known to be low.
        assert console.ask("up.arm")["outcome"] == "NACK"
        listener.until(lambda: listener.frames, "frames of a listener")
        assert listener.status["role"] == "observer"
        assert console.status["refused"] == listener.status["refused"] == 0
        with Client(proxy.ground_port, f"UP1 aircraft={AIRCRAFT} seat=listen packed=1\n") as relay:
            sealed = (to_body(each[:-1]) for each in relay.file if each[0] == PROTECTED)
            payloads = [each[1 + HEADER_BYTES] for each in islice(sealed, 40)]
        assert PACKED in payloads, "all grounds read packed telemetry"

        revoke_key(daemon.folder, "tablet")
        console.until(lambda: console.status["key_fault"] == "revoked", "the refusal")
        refused = console.ask("up.telemetry.frequency", frequency=60)
        assert (refused["outcome"], refused["code"]) == ("REFUSED", "revoked")
        last = console.frames[-1]["beacon"]
        listener.until(lambda: listener.frames[-1]["beacon"] > last + 20, "the new streams")
        assert console.frames[-1]["beacon"] == last, "a revoked key reads nothing more"
