"""The page and an aircraft's own listener: a real aircraft, without a proxy."""

import json

import pytest

from tests.cogs.mission_control_cog.system import Aircraft
from tests.ground.web.page import Page, Serve
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.telemetry_commands import TelemetryFrequencyCommand
from up.config.keys_file import add_key
from up.protocols.pairing import Pairing
from up_ground.key_store import KeyStore

KEYED = "listener: {port: 0, address: 127.0.0.1, security: require}\naircraft: kite\n"
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


def test_a_pairing_text_pasted_into_the_page_opens_the_protected_link(tmp_path):
    """A ground station without a key learns one, which only this user may read."""
    config = tmp_path / "aircraft"
    store = KeyStore(tmp_path / "state" / "up-ground")

    def new_key(name, role):
        key_id, key = add_key(config, name, role)
        return Pairing("kite", key_id, key.secret, role, name)

    async def ask(page, ask, pairing):
        page.send("pair", ask=ask, pairing=pairing.encode())
        return await page.next("pair.answer", lambda each: each["ask"] == ask)

    async def is_protected(page, name):
        text = f"end to end: {name} (pilot)"
        status = await page.status(lambda each: each["link"]["security_text"] == text)
        assert (status["link"]["security"], status["role"]) == ("end_to_end", "pilot")

    async def fly():
        async with Aircraft(tmp_path / "aircraft", None, KEYED) as aircraft:
            aircraft.listen_to(TelemetryFrequencyCommand)
            where = f"kite@127.0.0.1:{aircraft.up.ports['ground']}/direct"
            with LanServe(tmp_path, 1, "--aircraft", where) as server:
                await until(lambda: "Ctrl-C" in server.said)
                page, guest = Page(server.port), Page(server.port)
                await page.hello("laptop", watch="kite")
                await page.status(lambda each: each["link"]["security"] == "plain")
                assert page.of("frame") == []
                tablet = new_key("tablet", "pilot")
                answer = await ask(page, 1, tablet)
                assert (answer["outcome"], answer["key"]) == ("ack", "tablet")
                assert store.all() == {"kite": tablet}
                await is_protected(page, "tablet")
                page.send("control", aircraft="kite", action="request")
                await page.status(lambda each: each["control"]["holder"] == "you")
                answer = await page.command("up.telemetry.frequency", PERIOD, aircraft="kite")
                assert answer["outcome"] == "ack"
                # A new key interrupts the link, which only its pilot may do.
                await guest.hello("guest", watch="kite")
                laptop = new_key("laptop", "pilot")
                assert (await ask(guest, 1, laptop))["code"] == "no_control"
                assert store.all() == {"kite": tablet}
                assert (await ask(page, 9, laptop))["outcome"] == "ack"
                await is_protected(page, "laptop")
                assert tablet.secret not in json.dumps([page.told, server.said, server.stderr])
                await page.leave()
                await guest.leave()
                server.process.terminate()
                await until(lambda: server.process.poll() is not None)

    run_in_reactor(fly)
    assert reactor.getDelayedCalls() == []
