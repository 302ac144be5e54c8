"""The summary of all aircraft: its rows, when it is sent, and what it does not reveal."""

import json
import re
from argparse import Namespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.ground import aircraft as small
from tests.ground.aircraft import Aircraft, frame
from tests.ground.web.hub import PAIRING, Bench, Kite
from tests.ground.web.page import FBW, MODE, Serve, sent, with_pages
from tests.support.scrape import scrape
from up.protocols.general_message import GeneralMessage
from up.protocols.pairing import parse_pairing
from up_ground.key_store import KeyStore
from up_ground.telemetry import NAME, Telemetry
from up_ground.web.fleet import ALARMS_DELAY_S, PATHS, row_of
from up_ground.web.serve import fleet_of

ALARM = {"kind": "failsafe", "code": "failsafe", "level": "alarm", "text": "Failsafe"}
MAX_ROW_BYTES = 1500


def heard(data, at_s=100.0):
    telemetry = Telemetry()
    telemetry.update(GeneralMessage(NAME, data), at_s)
    return telemetry


def test_a_row_has_the_values_of_the_list_their_ages_and_the_alarms():
    data = frame(navigation={"latitude": 50.12345678, "height": 82.34, "speed": True, "sd": {}})
    data["arduino"] |= {"flight_battery_v": 11.754, "flight_battery_low": False}
    data["age_ms"]["heading"] = None
    row = row_of("kite", heard(data), [ALARM], 100.25)
    assert row == {
        "name": "kite",
        "alarms": [ALARM],
        "age_ms": 250,
        "data": {
            "orientation": {"yaw": 271.0},
            "location": {"latitude": 50.0755, "longitude": 14.4378},
            "navigation": {"latitude": 50.123457, "height": 82.3},
            "heading": {"actual": 88.0},
            "flight_mode": "FBW",
            "armed": False,
            "arduino": {"flight_battery_v": 11.75, "flight_battery_low": False},
            "age_ms": {"orientation": 12, "location": 600, "heading": None},
        },
    }


def test_an_aircraft_without_telemetry_has_no_values():
    assert row_of("kite", Telemetry(), [], 5.0) == {"name": "kite", "alarms": []}


_ANY = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.just("x" * 5000),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=6,
)
_KEYS = sorted({step for path in PATHS for step in path.split(".")} | {"age_ms"})
_TREE = st.dictionaries(
    st.sampled_from(_KEYS), st.dictionaries(st.sampled_from(_KEYS), _ANY, max_size=6) | _ANY
)


@settings(max_examples=40, deadline=None)
@given(_TREE)
def test_whatever_an_aircraft_sends_its_row_is_small(data):
    row = row_of("kite", heard(data), [], 101.0)
    assert len(json.dumps(row, allow_nan=False)) < MAX_ROW_BYTES


class Fleet(Bench):
    def __init__(self):
        super().__init__()
        self.gull = Kite()
        self.gull.name = "gull"
        self.gull.status = lambda page: {"type": "status", "aircraft": "gull"}
        self.pages.fleet["gull"] = self.gull
        self.pages.start()
        self.link = self.open()
        self.send(self.link, type="watch", aircraft="gull")
        self.link.output.sent.clear()


def test_each_second_brings_all_rows_and_the_status_of_the_watched_one_alone():
    bench = Fleet()
    for _ in range(3):
        bench.clock.advance(1.0)
    of = [(each["type"], each.get("aircraft")) for each in bench.link.told]
    assert of == [("status", "gull"), ("fleet", [{"name": "kite"}, {"name": "gull"}])] * 3
    # A change, as of control, reaches pages that look elsewhere.
    bench.pages.send_status("kite")
    assert bench.link.told[-1] == {"type": "status", "aircraft": "kite"}


def test_the_alarms_of_a_moment_leave_soon_and_together():
    bench = Fleet()
    for _ in range(50):
        bench.pages.on_alarms()
    bench.clock.advance(ALARMS_DELAY_S)
    (message,) = bench.link.told
    assert (message["type"], message["age_ms"]) == ("fleet", 0.0)
    bench.clock.advance(0.5)
    assert len(bench.link.told) == 1


def test_a_server_with_one_aircraft_sends_no_summary():
    bench = Bench()
    bench.pages.start()
    link = bench.open()
    bench.pages.on_alarms()
    bench.clock.advance(1.0)
    assert "fleet" not in link.kinds()


@pytest.mark.parametrize(
    ("named", "names"),
    [(None, ["eagle", "kite"]), (["kite@h:1/direct", "gull"], ["kite", "gull", "eagle"])],
)
def test_the_paired_aircraft_are_shown_with_their_keys(tmp_path, monkeypatch, named, names):
    monkeypatch.setenv("UP_GROUND_STATE", str(tmp_path))
    for text in (PAIRING, PAIRING.replace("kite", "eagle")):
        KeyStore(tmp_path).put(parse_pairing(text))
    place = {"host": "proxy.example", "port": 3004, "direct": False, "tls": None}
    chosen = fleet_of(Namespace(**place, aircraft="default", fleet=named, paired=True))
    assert [each.aircraft for each in chosen] == names
    keyless = [each.aircraft for each in chosen if each.pairing is None]
    assert keyless == [name for name in names if name == "gull"]
    assert chosen[-1].host == "proxy.example"


@pytest.fixture
def gull(proxy):
    with Aircraft(proxy.airborne_port, hello=b"UP1 aircraft=gull\n") as aircraft:
        yield aircraft


@pytest.fixture
def foreign(proxy):
    with Aircraft(proxy.airborne_port, hello=b"UP1 aircraft=foreign\n") as aircraft:
        yield aircraft


def test_control_stays_with_its_aircraft_and_nothing_of_others_is_shown(
    proxy, aircraft, gull, foreign, tmp_path
):
    words = ["--aircraft", small.NAME, "--aircraft", "gull", "--metrics", "0"]
    with Serve(tmp_path, proxy.ground_port, *words) as server:
        port = int(re.search(r":(\d+)/", server.event("metrics_open")["url"])[1])

        async def look(page):
            def is_live(message):
                return all("data" in row for row in message["aircraft"])

            names = [row["name"] for row in (await page.next("fleet", is_live))["aircraft"]]
            assert names == page.newest("welcome")["aircraft"] == [small.NAME, "gull"]
            await page.control()
            page.send("watch", aircraft="gull")
            beacon = (await page.next("frame", lambda each: each["aircraft"] == "gull"))["beacon"]
            answer = await page.command(MODE, FBW, aircraft="gull", beacon=beacon)
            assert (answer["outcome"], answer["code"]) == ("refused", "no_control")
            page.told.clear()
            # Control of the first one was neither moved nor lost.
            page.send("watch")
            await page.status(lambda each: each["control"]["holder"] == "you")
            page.told.clear()
            await page.next("frame", lambda each: each["aircraft"] == small.NAME)
            assert (await page.command(MODE, FBW))["outcome"] == "ack"
            faults = []
            for name in ("foreign", "nobody"):
                page.told.clear()
                page.send("watch", aircraft=name)
                faults.append(await page.next("fault"))
            assert faults[0] == faults[1]
            assert faults[0]["code"] == "unknown_aircraft"
            assert "foreign" not in json.dumps(page.told)

        with_pages(server, look, "pilot")
        assert {labels[0] for name, *labels in scrape(port) if labels} == {small.NAME, "gull"}
        assert "foreign" not in server.said
    assert sent(gull) == sent(foreign) == []
    assert len(sent(aircraft)) == 1
