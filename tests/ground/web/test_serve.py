"""`up-ground serve` as a whole: a real proxy, an aircraft, pages, other grounds."""

from tests.ground.aircraft import Aircraft, frame, until
from tests.ground.web.page import FBW, MODE, Page, Serve, get, sent, with_pages
from tests.proxy.program import Program
from tests.support.reactor import run_in_reactor
from tests.support.reactor import until as soon

GAINS = {
    name: {axis: {"p": 1.0, "i": 0.5, "d": 0.0} for axis in ("ailerons", "elevator", "rudder")}
    for name in ("ratePIDs", "stabPIDs", "navPIDs")
}


def test_a_page_sees_the_aircraft(aircraft, server):
    async def look(page):
        welcome = page.newest("welcome")
        assert (len(welcome["aircraft"]), welcome["may_control"]) == (1, True)
        shown = await page.next("frame")
        assert shown["data"]["orientation"]["roll"] == 12.5
        assert 0 <= shown["age_ms"] < 900
        status = await page.status(lambda each: each["link"]["frames"] > 2)
        assert status["link"]["state"] == "connected"
        assert status["link"]["aircraft_online"] is True
        assert abs(status["home"]["latitude"] - 50.0757) < 0.001
        # The first track may precede the first frame: a page that connects now has points.
        page.send("watch")
        track = await page.next("track", lambda each: each["points"])
        assert track["points"][-1][:2] == [50.0755, 14.4378]
        page.send("ping", ping=7)
        assert (await page.next("pong"))["ping"] == 7

    with_pages(server, look, "laptop")


def test_only_the_page_with_control_commands_and_with_its_own_beacon(aircraft, server):
    async def fly(first, second):
        answer = await first.command(MODE, FBW)
        assert (answer["outcome"], answer["code"]) == ("refused", "no_control")
        await first.control()
        shown = await first.next("frame")
        # Newer frames have come since: what counts is what this page has shown.
        await soon(lambda: len(first.of("frame")) > 5)
        answer = await first.command(MODE, FBW, beacon=shown["beacon"])
        assert answer["outcome"] == "ack"
        assert 0 < answer["round_trip_ms"] < 5000
        answer = await second.command(MODE, FBW, beacon=shown["beacon"])
        assert (answer["outcome"], answer["code"]) == ("refused", "no_control")
        return shown["beacon"]

    beacon = with_pages(server, fly, "first", "second")
    assert [each["beacon"] for each in sent(aircraft)] == [beacon]


def test_a_refusal_of_the_aircraft_and_one_of_the_ground(proxy, server):
    def refuse(message):
        return [("up.nack", {"id": message["id"], "code": "refused", "reason": "not at AUTO"})]

    async def fly(page):
        await page.control()
        answer = await page.command(MODE, FBW)
        assert (answer["outcome"], answer["code"], answer["reason"]) == (
            "nack",
            "refused",
            "not at AUTO",
        )
        for name, data, code in (
            ("up.flight_mode.sett", {}, "unknown"),
            (MODE, {"mode": 5}, "invalid"),
            (MODE, {"mode": "FBW", "more": 1}, "invalid"),
            ("up.system.stop", {}, "forbidden"),
            ("up.ack", {"id": "1"}, "forbidden"),
        ):
            answer = await page.command(name, data)
            assert (answer["outcome"], answer["code"]) == ("refused", code), name

        answer = await page.command("up.arm", beacon=None)
        assert (answer["outcome"], answer["code"]) == ("refused", "no_beacon")
        answer = await page.command("my.own", {"x": 1}, force=True)
        assert answer["outcome"] == "ack"
        answer = await page.command("up.system.stop", {}, force=True)
        assert (answer["outcome"], answer["code"]) == ("refused", "forbidden")

    with Aircraft(proxy.airborne_port, answers={MODE: refuse}) as aircraft:
        with_pages(server, fly, "pilot")
        names = {each["name"] for each in aircraft.received}
        assert names <= {MODE, "my.own", "arduino.pids.tunings"}


def test_no_command_leaves_without_telemetry_that_was_seen(aircraft, server):
    async def fly(page):
        await page.control()
        seen = await page.beacon()
        # A page that has drawn nothing sends None; the other beacons were never received.
        for beacon, code in (
            (None, "no_beacon"),
            (7, "stale"),
            (-5, "stale"),
            (seen + 10**6, "unknown_beacon"),
        ):
            answer = await page.command(MODE, FBW, beacon=beacon)
            assert (answer["outcome"], answer["code"]) == ("refused", code), beacon
        answer = await page.command("up.arm", beacon=7)
        assert (answer["outcome"], answer["code"]) == ("refused", "stale")
        assert (await page.command(MODE, FBW))["outcome"] == "ack"
        return page.newest("frame")["beacon"]

    beacon = with_pages(server, fly, "pilot")
    (one,) = sent(aircraft)
    assert one["beacon"] <= beacon
    assert sent(aircraft, "up.arm") == []


def test_one_ask_is_sent_once(aircraft, server):
    async def fly(page):
        await page.control()
        beacon = await page.beacon()
        for _ in range(3):
            page.send("command", ask=1, name=MODE, data=FBW, beacon=beacon)
        await soon(lambda: page.of("answer"))
        page.send("command", ask=1, name=MODE, data=FBW)
        await soon(lambda: len(page.of("answer")) == 2)
        page.send("command", ask=1, name=MODE, data={"mode": "RATE"})
        assert (await page.next("fault"))["code"] == "ask_repeated"

    with_pages(server, fly, "pilot")
    assert len(sent(aircraft)) == 1


def test_gains_are_asked_for_set_and_remembered(proxy, server):
    flying = {**GAINS}

    def tune(message):
        if not message["data"].get("request"):
            flying.update(message["data"]["pids"])
            return [("up.ack", {"id": message["id"]})]
        return [("up.ack", {"id": message["id"]}), ("arduino.pids.values", flying)]

    changed = {**GAINS, "ratePIDs": GAINS["stabPIDs"] | {"rudder": {"p": 3.0, "i": 0, "d": 0}}}

    async def fly(page, other):
        await page.control()
        gains = await page.next("gains", lambda each: each["flying"])
        assert gains["flying"] == GAINS
        answer = await other.command("arduino.pids.tunings", {"request": True})
        assert (answer["outcome"], answer["data"]) == ("ack", GAINS)
        answer = await page.command("arduino.pids.tunings", {"pids": changed})
        assert answer["outcome"] == "ack"
        for each in (page, other):
            gains = await each.next("gains", lambda each: each["flying"] == changed)
            (change,) = gains["history"]
            assert (change["by"], change["outcome"]) == ("pilot", "ack")
            assert (change["before"], change["after"]) == (GAINS, changed)
            event = await each.next("event", lambda each: each["kind"] == "gains")
            assert (event["code"], event["fields"]["by"]) == ("gains_ack", "pilot")

    with Aircraft(proxy.airborne_port, answers={"arduino.pids.tunings": tune}):
        with_pages(server, fly, "pilot", "other")


def test_whoever_takes_control_sees_the_gains_that_fly_now(proxy, server):
    """Another ground may have changed them: a page must not send back those that it saw before."""
    flying = {**GAINS}

    def tune(message):
        return [("up.ack", {"id": message["id"]}), ("arduino.pids.values", flying)]

    async def fly(page, other):
        await page.control()
        await page.next("gains", lambda each: each["flying"] == GAINS)
        roll = {"p": 2.0, "i": 0.5, "d": 0.0}
        flying["ratePIDs"] = {**GAINS["ratePIDs"], "ailerons": roll}
        other.send("control", action="request")
        await page.status(lambda each: each["control"]["asks_you"])
        page.send("control", action="give")
        gains = await other.next("gains", lambda each: each["flying"] not in (None, GAINS))
        assert gains["flying"] == flying

    with Aircraft(proxy.airborne_port, answers={"arduino.pids.tunings": tune}):
        with_pages(server, fly, "pilot", "other")


def test_without_a_proxy_it_serves_says_so_and_comes_back(tmp_path):
    with Program(tmp_path / "a", "metrics: false\n") as first:
        ports = first.airborne_port, first.ground_port, None
    with Serve(tmp_path, ports[1]) as server:

        async def look(page):
            status = await page.status(lambda each: each["link"]["state"] == "waiting")
            assert status["link"]["code"] == "unreachable"
            assert status["control"]["holder"] == "unknown"
            page.send("control", action="request")
            answer = await page.command("arduino.profile.request")
            assert (answer["outcome"], answer["code"]) == ("unsent", "no_link")
            with (
                Program(tmp_path / "b", "metrics: false\n", ports=ports) as proxy,
                Aircraft(proxy.airborne_port),
            ):
                await page.next("frame")
                await page.status(lambda each: each["control"]["holder"] == "you")
                assert (await page.command(MODE, FBW))["outcome"] == "ack"
            await page.status(lambda each: each["link"]["state"] != "connected")
            answer = await page.command(MODE, FBW)
            assert (answer["outcome"], answer["code"]) == ("unsent", "no_link")
            await page.next("alarms", lambda each: each["active"])

        assert get(server.port, "/")[0] == 200
        with_pages(server, look, "pilot")


def test_an_aircraft_that_is_not_there_gets_no_late_command(proxy, server):
    async def fly(page):
        await page.control()
        answer = await page.command(MODE, FBW)
        assert (answer["outcome"], answer["code"]) == ("unsent", "no_aircraft")

    with_pages(server, fly, "pilot")
    with Aircraft(proxy.airborne_port) as aircraft:
        until(lambda: aircraft.beacon > 4720, "telemetry")
        assert sent(aircraft) == []


def test_several_aircraft_are_kept_apart(proxy, tmp_path):
    async def look(port):
        page = Page(port)
        welcome = await page.hello("laptop", watch="kite")
        assert welcome["aircraft"] == ["kite", "glider"]
        await page.next("frame", lambda each: each["data"]["altitude"] == 1.0)
        assert {each["aircraft"] for each in page.of("frame")} == {"kite"}
        page.send("watch", aircraft="glider")
        await page.next("frame", lambda each: each["data"]["altitude"] == 2.0)
        await soon(lambda: {each["aircraft"] for each in page.of("status")} == {"kite", "glider"})
        page.send("watch", aircraft="none")
        assert (await page.next("fault"))["code"] == "unknown_aircraft"
        await page.leave()

    with (
        Aircraft(proxy.airborne_port, data=frame(altitude=1.0), hello=b"UP1 aircraft=kite\n"),
        Aircraft(proxy.airborne_port, data=frame(altitude=2.0), hello=b"UP1 aircraft=glider\n"),
        Serve(
            tmp_path,
            1,
            "--aircraft",
            f"kite@127.0.0.1:{proxy.ground_port}",
            "--aircraft",
            f"glider@127.0.0.1:{proxy.ground_port}",
        ) as server,
    ):
        run_in_reactor(look, server.port)
