"""`up-ground serve` as a program: keys, places, its end, its mistakes."""

import signal

import pytest
from twisted.internet.threads import deferToThread

from tests.ground.aircraft import coded, ground
from tests.ground.web.page import FBW, MODE, Page, Serve, get, sign_in, with_pages
from tests.support.reactor import until as soon


@pytest.mark.parametrize("arguments", [("--listen", "0.0.0.0:0"), ("--key", "a-good-key")])
def test_who_has_no_key_only_watches(aircraft, proxy, tmp_path, arguments):
    with Serve(tmp_path, proxy.ground_port, *arguments) as server:
        key = "a-good-key"
        if "--key" not in arguments:
            path = tmp_path / "state" / "up-ground" / "page.key"
            assert path.stat().st_mode & 0o777 == 0o600
            key = path.read_text().strip()
        assert key not in (
            server.said if "--key" in arguments else server.event("page_open")["url"]
        )

        async def look(page):
            assert page.newest("welcome")["may_control"] is False
            assert page.newest("welcome")["denial"]["code"] == "no_key"
            await page.next("frame")
            page.send("control", action="request")
            assert (await page.next("fault"))["code"] == "watch_only"
            answer = await page.command(MODE, FBW)
            assert answer["code"] == "no_control"
            for wrong in (key[:-1], key + "x", key.swapcase(), ""):
                assert await deferToThread(sign_in, server.port, wrong) == (403, "")
            # No message of a page is a way around the cookie.
            other = Page(server.port)
            assert (await other.hello("x", key=key))["may_control"] is False
            await other.leave()
            status, cookie = await deferToThread(sign_in, server.port, key)
            assert status == 204
            pilot = Page(server.port, cookie=cookie)
            assert (await pilot.hello("pilot"))["may_control"] is True
            await pilot.control()
            await pilot.leave()

        with_pages(server, look, "guest")


def test_watch_only_is_for_everybody(aircraft, proxy, tmp_path):
    with Serve(tmp_path, proxy.ground_port, "--watch-only") as server:

        async def look(page):
            assert page.newest("welcome")["may_control"] is False
            page.send("control", action="request")
            assert (await page.next("fault"))["code"] == "watch_only"

        with_pages(server, look, "guest")


def test_user_signals_end_nothing(server):
    for number in (signal.SIGUSR1, signal.SIGUSR2):
        server.process.send_signal(number)
    assert get(server.port, "/")[0] == 200


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_ends_it_without_a_word(aircraft, proxy, tmp_path, number):
    with Serve(tmp_path, proxy.ground_port) as server:

        async def look(page):
            await page.control()
            server.process.send_signal(number)
            await soon(lambda: page.is_closed)
            assert page.code == 4001

        with_pages(server, look, "pilot")
        assert server.wait() == 0
        assert server.stderr == ""
    # The seat was left: no page waits for it.
    assert ground(tmp_path / "b", proxy.ground_port, "send", MODE, "mode=FBW")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (("--listen", "8080"), "invalid_listen"),
        (("--listen", "example.com:80"), "invalid_listen"),
        (("--listen", "127.0.0.1:70000"), "invalid_listen"),
        (("--listen", "203.0.113.1:8080"), "listen_failed"),
        (("--aircraft", "a/b"), "invalid_aircraft"),
        (("--aircraft", "a", "--aircraft", "a"), "duplicate_aircraft"),
        (("--aircraft", "a@h:0"), "invalid_aircraft"),
        (("--aircraft", "<b>a"), "invalid_aircraft"),
        (("--paired",), "not_paired"),
        (("--key", "short"), "argument --key"),
        (("--name", "a b"), "argument --name"),
        (("--tiles", "http://tiles.example/{z}/{x}.png"), "invalid_tiles"),
        (("--tiles", "ftp://tiles.example/{z}/{x}/{y}.png"), "invalid_tiles"),
    ],
)
def test_mistakes_in_the_command_line_are_one_sentence(tmp_path, arguments, code):
    status, said, stderr = ground(tmp_path, 1, "serve", *arguments)
    assert status in (2, 3)
    assert said == ""
    assert code in stderr


def test_a_port_that_is_taken_is_a_sentence(server, tmp_path):
    listen = f"127.0.0.1:{server.port}"
    status, _, stderr = ground(tmp_path, 1, "serve", "--listen", listen)
    assert (status, coded(stderr)) == (3, [{"code": "listen_failed", "address": listen}])
