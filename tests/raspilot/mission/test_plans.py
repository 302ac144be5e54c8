import json

import pytest

from tests.raspilot.mission.plans_rig import SQUARE, PlansRig, items_of, placed
from tests.raspilot.navigation_rig import refusal
from up.commands.mission_commands import (
    MissionItemCommand,
    MissionProblemsCommand,
    MissionRequestCommand,
)
from up.commands.navigation_commands import HomeCommand
from up.config import atomic_writer
from up.mission.items import plan_id

LONG = [placed(300 + 100 * (each % 2), 60.0 * each) for each in range(45)]
FENCE = [{"latitude": 48.0, "longitude": 17.0, "radius": 2000.0}]


@pytest.fixture
def rig(tmp_path):
    made = PlansRig(tmp_path)
    made.state(in_flight=False)
    made.navigation.set()
    made.frame()
    return made


def shown(rig):
    return rig.plans.telemetry_content


class TestUpload:
    """A plan is used as a whole, or not."""

    def test_parts_may_come_in_any_order_and_twice(self, rig):
        for first in (41, 1, 21, 41, 1):
            assert rig.part(LONG, first) == [None]
        assert rig.commit(LONG) == [None]
        assert shown(rig)["mission"]["id"] == plan_id(items_of(LONG))
        assert shown(rig)["mission"]["count"] == 45

    def test_while_a_part_is_lost_the_plan_is_refused_and_the_old_one_stays(self, rig):
        rig.upload(SQUARE)
        rig.part(LONG, 1)
        rig.part(LONG, 41)
        assert refusal(rig.commit(LONG)) == "plan_incomplete"
        assert shown(rig)["mission"]["id"] == plan_id(items_of(SQUARE))
        rig.part(LONG, 21)
        assert rig.commit(LONG) == [None]

    def test_parts_of_another_plan_replace_those_that_wait(self, rig):
        rig.part(LONG, 1)
        rig.part(SQUARE)
        rig.part(LONG, 21)
        rig.part(LONG, 41)
        assert refusal(rig.commit(LONG)) == "plan_incomplete"

    def test_other_items_than_the_identity_says_are_refused(self, rig):
        other = [*SQUARE[:2], placed(0, 390), SQUARE[3]]
        assert refusal(rig.upload(other, identity=plan_id(items_of(SQUARE)))) == "plan_changed"
        assert shown(rig)["mission"]["count"] == 0

    def test_a_part_beside_the_plan_is_refused(self, rig):
        assert refusal(rig.part(SQUARE, 3, count=3)) == "plan_changed"

    def test_a_commit_repeated_is_answered_again(self, rig):
        rig.upload(SQUARE)
        rig.outcome(MissionItemCommand(3))
        assert rig.commit(SQUARE) == [None]
        assert shown(rig)["mission"]["item"] == 3

    def test_a_plan_in_use_that_is_uploaded_again_is_checked_again(self, rig):
        rig.upload(FENCE, "fence")
        rig.outcome(HomeCommand(48.03, 17.0))
        assert refusal(rig.upload(FENCE, "fence")) == "plan_invalid"
        assert rig.ground.sent[-1].problems[0]["code"] == "home_outside"

    def test_problems_go_to_the_ground_by_item_and_code(self, rig):
        bad = [placed(400, 0), placed(40_000, 0), {**placed(0, 0), "altitude": "high"}]
        assert refusal(rig.upload(bad, identity="0" * 16)) == "plan_invalid"
        sent = rig.ground.sent[-1]
        assert isinstance(sent, MissionProblemsCommand)
        assert [(each["item"], each["code"]) for each in sent.problems] == [(3, "item_invalid")]
        bad = [*bad[:2], placed(0, 400)]
        assert refusal(rig.upload(bad)) == "plan_invalid"
        found = {(each["item"], each["code"]) for each in rig.ground.sent[-1].problems}
        assert found == {(2, "too_far")}

    def test_a_fence_that_excludes_home_or_the_mission_is_refused(self, rig):
        far = [{"latitude": 48.0, "longitude": 17.1, "radius": 2000.0}]
        assert refusal(rig.upload(far, "fence")) == "plan_invalid"
        assert rig.ground.sent[-1].problems[0]["code"] == "home_outside"
        rig.upload(SQUARE)
        small = [{"latitude": 48.0, "longitude": 17.0, "radius": 300.0}]
        assert refusal(rig.upload(small, "fence")) == "plan_invalid"
        assert rig.ground.sent[-1].problems[0]["code"] == "home_outside"
        assert rig.upload(FENCE, "fence") == [None]
        assert shown(rig)["fence"] == {"id": plan_id(items_of(FENCE, "fence")), "count": 1}

    def test_count_0_removes_the_plan_and_its_file(self, rig, tmp_path):
        rig.upload(SQUARE)
        assert (tmp_path / "mission.json").exists()
        assert rig.commit([]) == [None]
        assert not (tmp_path / "mission.json").exists()
        assert shown(rig)["mission"]["item"] is None


class TestReadBack:
    """The aircraft sends the plan in use."""

    def test_all_parts_are_the_plan(self, rig):
        rig.upload(LONG)
        read = []
        while len(read) < 45:
            assert rig.outcome(MissionRequestCommand("mission", len(read) + 1)) == [None]
            part = rig.ground.sent[-1]
            assert (part.first, part.count) == (len(read) + 1, 45)
            read += part.items
        assert plan_id(items_of(read)) == part.plan_id == plan_id(items_of(LONG))

    def test_borders_with_many_corners_fit_into_a_message(self, rig):
        corners = [[48.0 + 0.0123456789012 * (-1) ** n, 17.0 + n / 7e4] for n in range(100)]
        rig.plans.fences.use(tuple(items_of([{"corners": corners}] * 3, "fence")), "x")
        assert rig.outcome(MissionRequestCommand("fence", 2)) == [None]
        assert len(rig.ground.sent[-1].items) == 1

    def test_without_a_mission_the_part_is_empty(self, rig):
        assert rig.outcome(MissionRequestCommand("mission")) == [None]
        assert rig.ground.sent[-1].count == 0
        assert refusal(rig.outcome(MissionRequestCommand("mission", 2))) == "no_item"

    def test_without_a_ground_it_is_refused(self, rig):
        rig.ground.is_there = False
        assert rig.outcome(MissionRequestCommand("mission"))[0].check(Exception)


class TestFile:
    """The plans survive the program."""

    def test_a_restart_uses_them_again(self, rig, tmp_path):
        rig.upload(SQUARE)
        rig.upload(FENCE, "fence")
        again = PlansRig(tmp_path, gains=None)
        assert shown(again)["mission"]["id"] == plan_id(items_of(SQUARE))
        assert shown(again)["fence"]["count"] == 1

    @pytest.mark.parametrize(
        ("damage", "code"),
        [
            (lambda text: text[: len(text) // 2], "cut_short"),
            (lambda text: text.replace('"altitude": 60.0', '"altitude": NaN', 1), "item_invalid"),
            (lambda text: text.replace('"altitude": 60.0', '"altitude": 61.0', 1), "plan_changed"),
            (lambda text: json.dumps({"items": [SQUARE[0]] * 10_000}), "wrong_type"),
            (lambda text: "[" * 100_000, "cut_short"),
            (lambda text: "\0" * 2_000_000, "file_too_large"),
        ],
    )
    def test_a_damaged_file_is_used_in_no_part_and_forbids_arming(
        self, rig, tmp_path, damage, code
    ):
        rig.upload(SQUARE)
        path = tmp_path / "mission.json"
        path.write_text(damage(path.read_text()))
        again = PlansRig(tmp_path, gains=None)
        assert shown(again)["mission"]["count"] == 0
        assert again.plans.missions.load().code == code
        assert "mission.json" in again.up.vetoes.own
        assert again.upload(SQUARE) == [None]
        assert "mission.json" not in again.up.vetoes.own

    def test_a_plan_that_is_not_saved_is_not_used(self, rig, monkeypatch):
        def refuse(*_):
            raise OSError(28, "No space left on device")

        rig.upload(SQUARE)
        monkeypatch.setattr(atomic_writer, "_write_and_sync", refuse)
        assert refusal(rig.upload(LONG)) == "plan_not_saved"
        assert shown(rig)["mission"]["id"] == plan_id(items_of(SQUARE))


class TestItem:
    """The item that is flown next."""

    def test_it_is_selected_and_told(self, rig):
        assert refusal(rig.outcome(MissionItemCommand(1))) == "no_mission"
        rig.upload(SQUARE)
        assert refusal(rig.outcome(MissionItemCommand(5))) == "no_item"
        assert rig.outcome(MissionItemCommand(2)) == [None]
        assert shown(rig)["mission"]["item"] == 2
        # The aircraft is at 100, 50, the item at 400, 400.
        assert shown(rig)["mission"]["distance"] == pytest.approx(461, abs=1)

    def test_after_a_flight_it_is_the_first_again(self, rig):
        rig.upload(SQUARE)
        rig.outcome(MissionItemCommand(2))
        rig.state(in_flight=True)
        assert shown(rig)["mission"]["item"] == 2, "selected before the flight"
        rig.state(in_flight=False)
        assert shown(rig)["mission"]["item"] == 1

    def test_it_survives_a_restart_in_flight_but_not_on_the_ground(self, rig, tmp_path):
        rig.upload(SQUARE)
        rig.state(in_flight=True)
        rig.outcome(MissionItemCommand(3))
        rig.manager.home.memory.wait()
        again = PlansRig(tmp_path, gains=None)
        again.state(in_flight=True)
        assert shown(again)["mission"]["item"] == 3
        ground = PlansRig(tmp_path, gains=None)
        ground.state(in_flight=False)
        assert shown(ground)["mission"]["item"] == 1
