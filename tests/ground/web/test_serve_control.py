"""Control of the aircraft on a real server: pages, other grounds, the seat of a real proxy."""

from tests.ground.aircraft import Ground, codes, ground
from tests.ground.web.page import FBW, MODE, Page, with_pages
from tests.support.reactor import until as soon


def test_a_page_that_vanishes_keeps_control_for_a_moment(aircraft, server):
    async def fly(page, other):
        await page.control()
        token = page.newest("welcome")["token"]
        await page.leave()
        other.send("control", action="request")
        again = Page(server.port)
        welcome = await again.hello("pilot", token=token)
        assert welcome["page"] == page.newest("welcome")["page"]
        await again.status(lambda each: each["control"]["holder"] == "you")
        assert (await again.command(MODE, FBW))["outcome"] == "ack"
        await again.leave()
        # Then it is free, and the next requesting page gets it.
        await other.status(lambda each: each["control"]["holder"] == "you")

    with_pages(server, fly, "pilot", "other")


def test_a_doubled_tab_is_another_page(aircraft, server):
    async def fly(page):
        await page.control()
        twin = Page(server.port)
        welcome = await twin.hello("twin", token=page.newest("welcome")["token"])
        assert welcome["page"] != page.newest("welcome")["page"]
        assert welcome["token"] != page.newest("welcome")["token"]
        status = await twin.status(lambda each: each["control"]["holder"] == "page")
        assert status["control"]["holder_name"] == "pilot"
        await twin.leave()

    with_pages(server, fly, "pilot")


def test_the_seat_is_free_when_no_page_wants_it(aircraft, server, proxy, tmp_path):
    async def fly(page):
        await page.control()
        page.send("control", action="release")
        await page.status(lambda each: each["control"]["holder"] == "nobody")

    assert ground(tmp_path / "a", proxy.ground_port, "send", MODE, "mode=FBW")[0] == 0
    with_pages(server, fly, "pilot")
    status, said, _ = ground(tmp_path / "b", proxy.ground_port, "send", MODE, "mode=FBW")
    assert (status, codes(said)) == (0, ["ack"])


def test_two_grounds_ask_each_other(aircraft, server, proxy, tmp_path):
    async def fly(page):
        page.send("control", action="request")
        status = await page.status(lambda each: each["control"]["asked_by"])
        assert status["control"]["asked_by"]["name"] == "pilot"
        assert status["control"]["holder"] == "ground"
        answer = await page.command(MODE, FBW)
        assert answer["code"] == "no_control"
        other.process.terminate()
        await page.status(lambda each: each["control"]["holder"] == "you")

    async def give(page):
        await page.control()
        with Ground(tmp_path / "c", proxy.ground_port, "seat", "request") as asking:
            status = await page.status(lambda each: each["control"]["asks_you"])
            assert status["control"]["asked_by"]["page"] is None
            page.send("control", action="give")
            await soon(lambda: asking.event("control_granted"))

    with Ground(tmp_path / "b", proxy.ground_port, "watch", "--seat", "command") as other:
        other.expect("control ours")
        with_pages(server, fly, "pilot")
    with_pages(server, give, "pilot")
