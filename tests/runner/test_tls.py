"""Requests by TLS: a process is started only for a client with a certificate."""

import ssl

import pytest

from tests.runner.runners import Talk
from tests.support.certificates import Certificates
from up.tls.files import TLSFiles


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    made = Certificates(tmp_path_factory.mktemp("certificates"))
    made.server("runner")
    made.client("phone")
    return made


def ask(runner, context, request):
    """Send a request by TLS and return the answer."""
    talk = Talk(runner.port)
    talk.lines.close()
    with (
        context.wrap_socket(talk.socket, server_hostname="127.0.0.1") as talk.socket,
        talk.socket.makefile("rb") as talk.lines,
    ):
        return talk.ask(request)


def test_only_a_client_with_a_certificate_starts_an_instance(runners, own):
    folder = own.authority.folder
    runner = runners(tls=str(folder / "runner")).start()
    request = {"aircraft": "glider-1"}
    anonymous = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    anonymous.load_verify_locations(folder / "ca.pem")
    stranger = own.of_another_ca("stranger")
    for context in (anonymous, TLSFiles(stranger).client()):
        with pytest.raises((ssl.SSLError, ConnectionError)):
            ask(runner, context, request)
    plain = runner.talk()
    plain.say(request)
    assert plain.ended()
    for code in ("tls_no_certificate", "tls_unknown_ca", "tls_peer_plain"):
        runner.logs(code)
    phone = TLSFiles(folder / "phone").client()
    assert ask(runner, phone, {**request, "action": "status"})["running"] is False
    assert ask(runner, phone, b'{"a": "' + b"x" * 70_000)["code"] == "too_long"
    assert runner.instances() == []
    assert ask(runner, phone, request)["spawned"] is True


def test_a_faulty_folder_stops_the_start(runners, own):
    runner = runners(tls="nowhere").launch()
    assert runner.process.wait(30) == 1
    runner._reader.join(30)
    assert [each["code"] for each in runner.events()] == ["tls_no_file"]
