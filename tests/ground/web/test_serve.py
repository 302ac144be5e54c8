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


def test_the_page_with_control_commands(proxy, tmp_path):
    async def fly(port):
        first, second = Page(port), Page(port)
        await first.hello("first")
        await second.hello("second")
        answer = await first.command("up.flight_mode.set", {"mode": "FBW"})
        assert (answer["outcome"], answer["code"]) == ("refused", "no_control")
        await first.control()
        frame = await first.next("frame")
        answer = await first.command("up.flight_mode.set", {"mode": "FBW"}, beacon=frame["beacon"])
        assert answer["outcome"] == "ack"
        answer = await second.command("up.flight_mode.set", {"mode": "FBW"})
        assert answer["code"] == "no_control"
        await first.leave()
        await second.leave()
        return frame["beacon"]

    with Aircraft(proxy.airborne_port) as aircraft, Serve(tmp_path, proxy.ground_port) as server:
        beacon = run_in_reactor(fly, server.port)
    sent = [each for each in aircraft.received if each["name"] == "up.flight_mode.set"]
    assert [each["beacon"] for each in sent] == [beacon]
