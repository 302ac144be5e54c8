"""up-ground by TLS, to a real proxy and to the page's browser."""

import ssl

import pytest
from twisted.internet.endpoints import TCP4ClientEndpoint

from tests.ground import aircraft
from tests.ground.aircraft import Aircraft, codes, ground
from tests.ground.web.page import Page, Serve
from tests.proxy.program import Program
from tests.support.certificates import Certificates
from tests.support.reactor import reactor, run_in_reactor, until
from up.tls.files import TLSFiles
from up.tls.protocol import TLSClientEndpoint

KEY = "the-right-key"


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    made = Certificates(tmp_path_factory.mktemp("certificates"))
    made.server()
    made.client("laptop")
    return made


@pytest.fixture(scope="module")
def relay(own, tmp_path_factory):
    folder = own.authority.folder / "relay"
    text = (
        "metrics: false\ntls: {folder: %s, airborne port: 0, ground port: 0, plain ports: true}\n"
    )
    with Program(tmp_path_factory.mktemp("proxy"), text % folder) as program:
        yield program


def test_the_terminal_shows_the_protection_and_the_name_of_the_proxy(relay, own, tmp_path):
    laptop = str(own.authority.folder / "laptop")
    with Aircraft(relay.airborne_port):
        port = relay.tls_port("ground")
        status, said, _ = ground(tmp_path, port, "watch", "--once", UP_GROUND_TLS=laptop)
    assert (status, "TLS relay" in said) == (0, True)


def test_a_failure_has_a_code(relay, own, tmp_path):
    words = ("send", "up.home.set", "--tls", str(own.of_another_ca("stranger")))
    status, _, stderr = ground(tmp_path, relay.tls_port("ground"), *words)
    assert (status, codes(stderr)) == (3, ["tls_unknown_ca"])


class SecurePage(Page):
    """A page by HTTPS."""

    def __init__(self, port, folder):
        super().__init__(port)
        self.folder = folder

    async def open(self):
        tcp = TCP4ClientEndpoint(reactor, "127.0.0.1", self.port)
        endpoint = TLSClientEndpoint(reactor, tcp, TLSFiles(self.folder), "127.0.0.1")
        self.client = await endpoint.connect(self.factory)
        await until(lambda: self.is_open or self.is_closed, what="the link")
        return self


def test_the_page_comes_by_https_and_shows_the_protection(relay, own, tmp_path, monkeypatch):
    # The name of the other test's aircraft stays reserved for a while.
    monkeypatch.setattr(aircraft, "NAME", "kite")
    folder = own.authority.folder
    words = ("--tls", str(folder / "laptop"), "--https", str(folder / "relay"), "--key", KEY)
    with (
        Aircraft(relay.airborne_port),
        Serve(tmp_path, relay.tls_port("ground"), *words) as server,
    ):
        assert server.event("page_open")["url"].startswith("https://127.0.0.1:")

        async def look():
            page = SecurePage(server.port, folder / "laptop")
            await page.hello("laptop")
            status = await page.status(lambda each: each["link"]["frames"] > 2)
            assert status["link"]["tls_peer"] == "relay"
            await page.leave()

        run_in_reactor(look)
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.load_verify_locations(folder / "ca.pem")
        assert get(server.port, context).startswith(b"HTTP/1.1 200 OK\r\n")
        signed_in = get(
            server.port, context, f"POST /session HTTP/1.1\r\nAuthorization: Bearer {KEY}"
        )
        assert signed_in.startswith(b"HTTP/1.1 204 ") and b"; Secure" in signed_in


def get(port, context, head="GET / HTTP/1.1"):
    """Request the page as a browser without a certificate does; return the whole answer."""
    import socket

    with (
        socket.create_connection(("127.0.0.1", port), 30) as plain,
        context.wrap_socket(plain, server_hostname="127.0.0.1") as connection,
    ):
        rest = "Host: 127.0.0.1\r\nConnection: close\r\n\r\n"
        connection.sendall(f"{head}\r\n{rest}".encode())
        answer = b""
        while chunk := connection.recv(65536):
            answer += chunk
        return answer
