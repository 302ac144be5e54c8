"""`up-ground serve` as a whole: a real proxy, an aircraft, pages."""

from tests.ground.aircraft import Aircraft
from tests.ground.web.page import Page, Serve
from tests.support.reactor import run_in_reactor


def test_a_page_sees_the_aircraft(proxy, tmp_path):
    async def look(port):
        page = Page(port)
        welcome = await page.hello("laptop")
        assert (welcome["aircraft"], welcome["may_control"]) == (["default"], True)
        frame = await page.next("frame")
        assert frame["data"]["orientation"]["roll"] == 12.5
        assert 0 <= frame["age_ms"] < 900
        status = await page.status(lambda each: each["link"]["frames"] > 2)
        assert status["link"]["state"] == "connected"
        assert status["link"]["aircraft_online"] is True
        await page.leave()

    with Aircraft(proxy.airborne_port), Serve(tmp_path, proxy.ground_port) as server:
        run_in_reactor(look, server.port)
