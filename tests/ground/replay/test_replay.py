import pytest

from tests.ground.aircraft import Ground, codes, ground
from tests.ground.replay.flight import LENGTH_S, write_flight
from tests.ground.web.page import Page, Serve
from tests.support.reactor import run_in_reactor
from tests.support.reactor import until as soon
from up.cli.main import main as up


class Replay(Ground):
    def __init__(self, folder, *arguments):
        super().__init__(folder, 1, "replay", "--listen", "127.0.0.1:0", *arguments)

    def __enter__(self):
        self.expect("Ctrl-C")
        return self

    port = Serve.port


@pytest.fixture(scope="module")
def replay(tmp_path_factory):
    folder = tmp_path_factory.mktemp("replay")
    with Replay(folder, str(write_flight(folder / "flight.mcap"))) as replay:
        yield replay


def test_a_flight_is_played_and_stopped_and_sought(replay):
    async def look():
        page = Page(replay.port)
        welcome = await page.hello("laptop", watch="kite")
        assert (welcome["is_replay"], welcome["may_control"]) == (True, False)
        assert welcome["denial"]["code"] == "replay"
        shown = await page.next("frame")
        assert 0 <= shown["age_ms"] < 900
        page.send("replay", action="pause")
        await soon(lambda: page.newest("replay")["is_playing"] is False)
        page.send("replay", action="seek", value=26.0)
        shown = await page.next("frame", lambda each: each["data"]["altitude"] == 126.0)
        assert (shown["beacon"], shown["data"]["armed"]) == (1260, False)
        told = [each["code"] for each in page.of("event") if each.get("is_past")]
        assert "disarmed" in told
        assert len((page.newest("track"))["points"]) > 20
        page.send("replay", action="speed", value=8)
        page.send("replay", action="play")
        await soon(lambda: page.newest("replay")["time_s"] == LENGTH_S)
        assert page.newest("replay")["is_playing"] is False
        assert page.newest("replay")["speed"] == 8
        await page.leave()

    run_in_reactor(look)


def test_events_and_alarms_come_while_it_plays(replay):
    async def look():
        page = Page(replay.port)
        await page.hello("laptop", watch="kite")
        page.send("replay", action="speed", value=4)
        page.send("replay", action="seek", value=9.0)
        page.send("replay", action="play")
        event = await page.next(
            "event", lambda each: each["code"] == "failsafe" and "is_past" not in each
        )
        assert event["age_ms"] < 1000
        await page.next("alarms", lambda each: each["active"])
        await page.leave()

    run_in_reactor(look)


def test_nothing_of_the_past_can_be_commanded(replay):
    async def look():
        page = Page(replay.port)
        await page.hello("laptop", watch="kite")
        page.send("control", aircraft="kite", action="request")
        assert (await page.next("fault"))["code"] == "replay"
        answer = await page.command("up.arm", aircraft="kite", beacon=1000)
        assert (answer["outcome"], answer["code"]) == ("refused", "replay")
        for value in ("x", None, -1):
            page.send("replay", action="seek", value=value)
        await soon(lambda: len(page.of("fault")) == 4)
        await page.leave()

    run_in_reactor(look)


def test_what_is_no_flight_is_one_sentence_with_the_status_of_up_log(tmp_path):
    (tmp_path / "text.mcap").write_text("nothing of the kind")
    (tmp_path / "empty.mcap").write_bytes(b"")
    for word, failed in {"text.mcap": 1, "empty.mcap": 1, "absent.mcap": 2, "": 2}.items():
        path = str(tmp_path / word) if word else ""
        status, _, stderr = ground(tmp_path, 1, "replay", path)
        assert (status, stderr.count("\n")) == (failed, 1)
        assert up(["log", "info", path]) == failed


def test_a_flight_that_was_cut_off_is_played_as_far_as_it_goes(tmp_path):
    path = write_flight(tmp_path / "flight.mcap")
    path.write_bytes(path.read_bytes()[:-20_000])
    with Replay(tmp_path, str(path)) as replay:
        assert "kite: flight" in replay.said


def test_without_an_application_it_takes_the_folder_that_is_named(tmp_path):
    for word in ("last", "3", "x.mcap"):
        status, _, stderr = ground(tmp_path, 1, "replay", word, "--folder", str(tmp_path / "none"))
        assert status == 2
        assert len(codes(stderr)) == 1


def test_within_a_silence_the_last_frame_is_shown_with_its_age(tmp_path):
    path = write_flight(tmp_path / "flight.mcap", gap=(13.0, 19.0))

    async def look():
        page = Page(replay.port)
        await page.hello("laptop", watch="kite")
        page.send("replay", action="pause")
        page.send("replay", action="seek", value=17.0)
        shown = await page.next("frame", lambda each: each["data"]["altitude"] == 113.0)
        assert 2300 < shown["age_ms"] < 4100
        await page.next("alarms", lambda each: [a["kind"] for a in each["active"]] == ["silent"])
        await page.leave()

    with Replay(tmp_path, str(path)) as replay:
        run_in_reactor(look)
