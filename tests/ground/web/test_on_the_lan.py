"""The page and an aircraft's own listener: a real aircraft, without a proxy."""

import pytest

from tests.cogs.mission_control_cog.system import Aircraft
from tests.ground.web.page import Page, Serve
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.telemetry_commands import TelemetryFrequencyCommand

LISTENER = "listener: {port: 0, address: 127.0.0.1}\nrole: operator\n"
PERIOD = {"frequency": 90.0}


class LanServe(Serve):
    def __enter__(self):
        # The aircraft lives on this very thread: the start is waited for by the coroutine.
        return self


@pytest.mark.parametrize("way", ["", "/direct"])
def test_the_page_commands_an_aircraft_without_a_proxy(tmp_path, way):
    async def fly():
        async with Aircraft(tmp_path / "aircraft", None, LISTENER) as aircraft:
            aircraft.listen_to(TelemetryFrequencyCommand)
            where = f"kite@127.0.0.1:{aircraft.up.ports['ground']}{way}"
            with LanServe(tmp_path, 1, "--aircraft", where) as server:
                await until(lambda: "Ctrl-C" in server.said)
                page = Page(server.port)
                await page.hello("laptop", watch="kite")
                status = await page.status(lambda each: each["role"])
                assert (status["role"], status["tune_in_flight"]) == ("operator", False)
                page.send("control", aircraft="kite", action="request")
                await page.status(lambda each: each["control"]["holder"] == "you")
                shown = page.newest("frame")
                answer = await page.command(
                    "up.telemetry.frequency", PERIOD, aircraft="kite", beacon=shown["beacon"]
                )
                assert answer["outcome"] == "ack"
                answer = await page.command("up.arm", aircraft="kite", beacon=shown["beacon"])
                assert (answer["outcome"], answer["code"]) == ("refused", "forbidden")
                page.send("control", aircraft="kite", action="release")
                await page.status(lambda each: each["control"]["holder"] in ("nobody", "unknown"))
                await page.leave()
                server.process.terminate()
                await until(lambda: server.process.poll() is not None)
            assert [each.period_ms for each in aircraft.heard] == [90.0]

    run_in_reactor(fly)
    assert reactor.getDelayedCalls() == []
