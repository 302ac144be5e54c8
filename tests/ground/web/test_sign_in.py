"""Signing in over real sockets: the key for a cookie, the cookie for control."""

import pytest
from twisted.internet.threads import deferToThread

from tests.ground.web.page import Page, Serve, get, sign_in
from tests.support.reactor import run_in_reactor, until

KEY = "the-right-key"
FOREIGN = "http://evil.example"


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with Serve(tmp_path_factory.mktemp("sign-in"), 1, "--key", KEY) as server:
        yield server
        assert KEY not in server.said + server.stderr


def set_cookie(port, method="POST", **headers):
    headers.setdefault("Authorization", f"Bearer {KEY}")
    status, answer, body = get(port, "/session", method, **headers)
    assert (status, body) == (204, b"")
    assert KEY not in str(answer)
    head, *attributes = answer["Set-Cookie"].split("; ")
    return head, {each.casefold() for each in attributes}


def test_the_cookie_is_for_this_server_alone_and_no_script_reads_it(server):
    cookie, attributes = set_cookie(server.port)
    name, _, token = cookie.partition("=")
    assert name == f"up_ground_{server.port}"
    assert len(token) == 43
    assert attributes == {"path=/", "max-age=604800", "httponly", "samesite=strict"}
    assert set_cookie(server.port)[0] != cookie


def test_behind_https_the_cookie_is_secure(server):
    _, attributes = set_cookie(server.port, Origin=f"https://127.0.0.1:{server.port}")
    assert "secure" in attributes


def test_only_the_servers_own_page_signs_in(server):
    own = f"http://127.0.0.1:{server.port}"
    assert sign_in(server.port, KEY, Origin=own)[0] == 204
    for origin in (FOREIGN, "null", "http://127.0.0.1:1"):
        assert sign_in(server.port, KEY, Origin=origin) == (403, "")
        assert get(server.port, "/session", "DELETE", Origin=origin)[0] == 403


@pytest.mark.parametrize("path", [f"/?key={KEY}", f"/session?key={KEY}", f"/link?key={KEY}"])
def test_a_key_in_an_address_is_refused(server, path):
    method = "POST" if path.startswith("/session") else "GET"
    status, answer, body = get(server.port, path, method, Authorization=f"Bearer {KEY}")
    assert (status, answer["Set-Cookie"]) == (400, None)
    assert b"sign in" in body and KEY.encode() not in body


def test_the_address_is_for_nothing_else(server):
    status, answer, _ = get(server.port, "/session")
    assert (status, answer["Allow"]) == (405, "POST, DELETE")
    assert sign_in(server.port, "") == (403, "")
    assert get(server.port, "/session", "POST")[0] == 403


def test_a_cookie_lets_a_page_control_until_it_signs_out(server):
    async def welcome(cookie, **more):
        page = Page(server.port, cookie=cookie, **more)
        return page, await page.hello(watch=None)

    async def talk():
        cookie, _ = await deferToThread(set_cookie, server.port)
        others = f"a=b; {cookie}; up_ground_1=x"
        for text, may_control in [
            (cookie, True), (others, True), ("", False), (cookie[:-1], False),
            (cookie.replace(str(server.port), "1"), False),
        ]:  # fmt: skip
            page, told = await welcome(text)
            assert (told["may_control"], told["signed_in"]) == (may_control, may_control), text
            await page.leave()
        # The browser sends the cookie with requests of other sites of this machine, too.
        page = await Page(server.port, cookie=cookie, origin=FOREIGN).open()
        assert not page.is_open
        page, told = await welcome(cookie)
        headers = {"Cookie": cookie, "Authorization": ""}
        out, attributes = await deferToThread(set_cookie, server.port, "DELETE", **headers)
        assert (out, "max-age=0" in attributes) == (f"up_ground_{server.port}=", True)
        await until(lambda: page.is_closed, what="the end of the signed out page")
        page, told = await welcome(cookie)
        assert (told["may_control"], told["denial"]["code"]) == (False, "no_key")
        await page.leave()

    run_in_reactor(talk)
