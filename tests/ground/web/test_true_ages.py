"""Reported and true ages behind links that delay everything; on real sockets.

Aircraft, proxy, server and page are programs on one machine, so that they have one clock.
"""

import contextlib
import json
import signal
import subprocess
import threading
import time
from pathlib import Path

import pytest

from tests.ground.aircraft import Aircraft, Ground, frame
from tests.ground.web.page import Page, Serve
from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.tools import need_tool
from up_simulator.link.model import LinkModel, LinkSettings
from up_simulator.link.relay import LinkRelay

REPORTED_AGES = Path(__file__).parent / "static/support/reported_ages.mjs"
SILENT_S, ROUNDING_S = 0.9, 0.003
DOUBT_S = 0.1
"""By so much a page may take a frame for younger than it is."""


class ClockedAircraft(Aircraft):
    """Sends its clock in each frame, and the same again for the test."""

    def tell(self, name, data, **more):
        if name == "up.telemetry.update":
            now_s = time.monotonic()
            data = {**data, "system": {"clock_ms": round(now_s * 1000)}, "sent_s": now_s}
        super().tell(name, data, **more)


@contextlib.asynccontextmanager
async def link_to(port):
    """Relay to a port by a link without any delay; ``up`` and ``down`` may be changed."""
    relay = LinkRelay(reactor, 0, "127.0.0.1", port, LinkModel(), LinkModel())
    relay.start()
    try:
        yield relay
    finally:
        await relay.stop()


@pytest.mark.parametrize(
    "slow", [LinkSettings(delay_ms=1500), LinkSettings(rate_bytes_s=15_000)], ids=["far", "thin"]
)
def test_a_frame_that_is_held_up_before_the_proxy_is_as_old_as_it_is(proxy, tmp_path, slow):
    async def fly():
        async with link_to(proxy.airborne_port) as link:
            with (
                ClockedAircraft(link.port),
                Serve(tmp_path, proxy.ground_port) as server,
                Ground(tmp_path, proxy.ground_port, "watch", "--plain") as terminal,
            ):
                page = Page(server.port)
                await page.hello("laptop")
                await until(lambda: len(page.of("frame")) > 40 and "flight mode" in terminal.said)
                assert page.newest("alarms")["active"] == []
                link.up.settings = slow
                await page.next(
                    "alarms", lambda each: each["active"] and each["active"][0]["code"] == "late"
                )
                count, lines = len(page.of("frame")), terminal.said.count("\n")
                await until(lambda: terminal.said.count("\n") > lines + 1)
                newest = terminal.said.splitlines()[-1]
                await until(lambda: len(page.of("frame")) > count + 5)
                link.up.settings = LinkSettings()
                await until(lambda: page.newest("frame")["age_ms"] < 1000 * SILENT_S)
                await until(lambda: page.newest("alarms")["active"] == [])
                await page.leave()
                assert "silent" in newest
                return page

    page = run_in_reactor(fly)
    trips_ms = [each["link"]["round_trip_ms"] or 0 for each in page.of("status")]
    least_s, oldest_s = float("inf"), 0.0
    for each in page.of("frame"):
        true_s = each["sent_ms"] / 1000 - each["data"]["sent_s"]
        told_s = each["age_ms"] / 1000
        least_s, oldest_s = min(least_s, true_s), max(oldest_s, true_s)
        assert told_s <= true_s + max(trips_ms) / 2000 + ROUNDING_S
        # The transit time of the fastest frame is all that cannot be known.
        assert told_s >= true_s - least_s - ROUNDING_S
    assert oldest_s > 1.3


class NodePage:
    """The page's own modules, run by Node; `told` grows while they run."""

    def __init__(self, port):
        self.told = []
        self._process = subprocess.Popen(
            [need_tool("node", "nodejs"), str(REPORTED_AGES), f"ws://127.0.0.1:{port}/link"],
            stdout=subprocess.PIPE,
            text=True,
        )
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.terminate()
        self._process.wait(30)
        self._thread.join(30)
        self._process.stdout.close()

    def hang(self):
        self._process.send_signal(signal.SIGSTOP)

    def wake(self):
        self._process.send_signal(signal.SIGCONT)

    def _read(self):
        for line in self._process.stdout:
            self.told.append(json.loads(line))


def judge(told):
    """Compare the page's reports with the truth; return the greatest true age."""
    for each in told:
        assert each["way_s"] >= each["trueWay_s"] - DOUBT_S - ROUNDING_S, each
        assert each["way_s"] <= each["trueWay_s"] + each["quickest_s"] + ROUNDING_S, each
    # From the aircraft to the server: no age includes the fastest frame's transit time.
    least_s = min(each["trueAge_s"] - each["trueWay_s"] for each in told)
    live_s = [each["trueAge_s"] for each in told if each["freshness"] == "live"]
    assert max(live_s, default=0.0) <= SILENT_S + DOUBT_S + least_s + ROUNDING_S
    return max(each["trueAge_s"] for each in told)


def test_a_page_behind_a_thin_line_draws_nothing_old_as_live(proxy, tmp_path):
    data = frame(pad="x" * 1500)

    async def fly():
        with (
            ClockedAircraft(proxy.airborne_port, data=data),
            Serve(tmp_path, proxy.ground_port) as server,
        ):
            async with link_to(server.port) as link:
                link.window = 96 * 1024
                with NodePage(link.port) as page:
                    await until(lambda: len(page.told) > 20)
                    link.down.settings = LinkSettings(rate_bytes_s=40_000)
                    await until(lambda: page.told[-1]["trueAge_s"] > 1.8)
                    count = len(page.told)
                    await until(lambda: len(page.told) > count + 20)
                    link.down.settings = LinkSettings()
                    await until(lambda: page.told[-1]["freshness"] == "live")
                return page.told

    told = run_in_reactor(fly)
    assert judge(told) > 1.8
    assert {each["freshness"] for each in told} == {"live", "stale"}


def test_a_page_that_hung_wakes_to_a_backlog_and_says_how_old_it_is(proxy, tmp_path):
    async def fly():
        with (
            ClockedAircraft(proxy.airborne_port),
            Serve(tmp_path, proxy.ground_port) as server,
            NodePage(server.port) as page,
        ):
            await until(lambda: len(page.told) > 20)
            page.hang()
            hung_s = time.monotonic()
            await until(lambda: time.monotonic() > hung_s + 2.0)
            page.wake()
            await until(lambda: max(each["trueAge_s"] for each in page.told) > 1.5)
            await until(lambda: page.told[-1]["freshness"] == "live")
            return page.told

    assert judge(run_in_reactor(fly)) > 1.5
