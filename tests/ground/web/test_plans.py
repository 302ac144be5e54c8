"""Missions and fences of the pages: a real server, a real proxy, the store of a real aircraft."""

import json

import pytest

from tests.ground import aircraft as names
from tests.ground.flying import Flying
from tests.ground.web.page import with_pages
from tests.support.reactor import until
from tests.up.mission.plans import document, simple, waypoint
from up.mission.items import Border, MissionItem, plan_id
from up_ground.web.messages import MAX_PLAN_BYTES, PageFault, Reader
from up_ground.web.plan_service import LISTED, read_file, write_file

POINT = {"kind": "waypoint", "latitude": 50.08, "longitude": 14.43, "altitude": 60}
MANY = [{**POINT, "latitude": 50 + each / 1e4} for each in range(700)]
CIRCLE = {"latitude": 50.08, "longitude": 14.43, "radius": 900}


@pytest.fixture
def aircraft(proxy, tmp_path):
    with Flying(proxy.airborne_port, tmp_path) as flying:
        yield flying


def ask(kind, page, number, **fields):
    page.send(kind, ask=number, **fields)
    return page.next("plan.answer", lambda each: each["ask"] == number)


def told(answer):
    return answer["outcome"], answer["code"]


def test_a_mission_is_uploaded_and_downloaded(server, aircraft):
    async def look(page):
        here = {"aircraft": names.NAME, "plan": "mission"}
        await page.control()
        beacon = await page.beacon()
        answer = await ask("plan.upload", page, 1, items=MANY, beacon=beacon, **here)
        assert (told(answer), answer["problems"]) == (("ack", ""), [])
        items = tuple(MissionItem.from_data(each) for each in MANY)
        assert aircraft.stores["mission"].items == items
        assert answer["plan_id"] == plan_id(items)
        progress = [(each["phase"], each["done"]) for each in page.of("plan.progress")]
        assert progress[0] == ("upload", 20)
        assert ("verify", 700) in progress
        answer = await ask("plan.download", page, 2, **here)
        assert answer["items"] == [each.data for each in items]

        aircraft.problems = {"mission": [{"item": 1, "code": "too_far", "text": "9 km"}]}
        beacon = page.newest("frame")["beacon"]
        answer = await ask("plan.upload", page, 3, items=[POINT], beacon=beacon, **here)
        assert (told(answer), answer["detail"]) == (("nack", "refused"), "plan_invalid")
        problem = {"plan": "mission", "item": 1, "code": "too_far", "text": "9 km"}
        assert (answer["problems"], answer["untold"]) == ([problem], 2)
        assert aircraft.stores["mission"].items == items

    with_pages(server, look, "one")


def test_what_a_page_may_not_is_refused(server, aircraft):
    async def look(holder, other):
        here = {"aircraft": names.NAME, "plan": "fence", "items": [CIRCLE]}
        await holder.control()
        beacon = await other.beacon()
        refused = await ask("plan.upload", other, 1, **here, beacon=beacon)
        assert told(refused) == ("refused", "no_control")
        assert told(await ask("plan.upload", holder, 1, **here)) == ("refused", "no_beacon")
        old = await ask("plan.upload", holder, 2, **here, beacon=7)
        assert told(old) == ("refused", "stale")
        wrong = await ask("plan.upload", holder, 3, **{**here, "items": [{}, CIRCLE, 7]})
        assert told(wrong) == ("refused", "plan_invalid")
        assert [(each["plan"], each["item"]) for each in wrong["problems"]] == [
            ("fence", 1),
            ("fence", 3),
        ]
        assert not [each for each in aircraft.received if each["name"].startswith("up.mission")]

        # While one transfer waits for the aircraft another one is refused.
        aircraft._answers["up.mission.commit"] = lambda message: []
        beacon = holder.newest("frame")["beacon"]
        holder.send("plan.upload", ask=4, **here, beacon=beacon)
        await holder.next("plan.progress", lambda each: each["phase"] == "commit")
        busy = await ask("plan.download", other, 2, aircraft=names.NAME, plan="fence")
        assert told(busy) == ("refused", "busy")

    with_pages(server, look, "one", "two")


def test_a_page_that_lost_control_does_not_commit(server, aircraft):
    parts = []

    async def look(page):
        aircraft._answers["up.mission.part"] = lambda message: parts.append(message["id"]) or []
        await page.control()
        here = {"aircraft": names.NAME, "plan": "mission", "items": [POINT]}
        answer = ask("plan.upload", page, 1, **here, beacon=await page.beacon())
        await until(lambda: parts, what="the part")
        page.send("control", action="release")
        await page.status(lambda each: each["control"]["holder"] != "you")
        aircraft.tell("up.ack", {"id": parts[0]})
        assert told(await answer) == ("refused", "no_control")
        assert "up.mission.commit" not in [each["name"] for each in aircraft.received]

    with_pages(server, look, "one")


def test_files_are_read_and_written_without_an_aircraft(server):
    async def look(page):
        text = json.dumps(document(waypoint(1), *[simple(2, 9999)] * 150), indent=4)
        assert len(text) > 40_000
        answer = await ask("plan.read", page, 1, name="a.plan", text=text)
        assert told(answer) == ("refused", "plan_invalid")
        assert (len(answer["problems"]), answer["untold"]) == (LISTED, 50)
        assert (answer["problems"][0]["item"], answer["detail"]) == (2, "command_unknown")
        assert (await page.next("welcome"))["max_message"] == MAX_PLAN_BYTES
        await whole_round(page)

    with_pages(server, look, "one")


async def whole_round(page):
    """The greatest plan is written, and its text read again."""
    corners = [[50 + each / 7e3, 14 + each / 7e3] for each in range(100)]
    borders = [{"corners": corners, "inside": False}] * 50
    answer = await ask("plan.write", page, 2, form="plan", items=MANY, borders=borders)
    assert told(answer) == ("ack", "")
    again = await ask("plan.read", page, 3, name="a.plan", text=answer["text"])
    assert again["items"] == [MissionItem.from_data(each).data for each in MANY]
    expected = [json.loads(json.dumps(Border.from_data(each).data)) for each in borders]
    assert again["borders"] == expected


def test_a_file_is_told_with_its_home_and_notes():
    text = json.dumps(document(waypoint(1), simple(2, 206, frame=2)))
    answer = read_file(Reader({"ask": 5, "name": "a.plan", "text": text}))
    assert (answer["ask"], answer["form"], answer["cruise_speed"]) == (5, "plan", 15.0)
    assert list(answer["home"]) == [50.07812345678901, 14.42, 231.5]
    assert [(each["item"], each["code"]) for each in answer["notes"]] == [(2, "left_out")]


def test_waypoints_have_no_place_for_a_fence():
    fields = {"ask": 1, "form": "waypoints", "items": [POINT], "borders": [CIRCLE]}
    answer = write_file(Reader(fields))
    assert (told(answer), answer["detail"]) == (("refused", "plan_invalid"), "no_fence")
    assert write_file(Reader({**fields, "borders": [], "home": [50, 14, 200]}))["text"]


@pytest.mark.parametrize("fields", [{"home": [91, 0, 0]}, {"items": {}}, {"form": "kml"}])
def test_a_request_of_a_wrong_form_is_a_fault(fields):
    with pytest.raises(PageFault):
        write_file(Reader({"ask": 1, "form": "plan", **fields}))
