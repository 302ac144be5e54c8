"""``up log replay``, the ground's verb, looks where the other verbs of ``up log`` look."""

import pytest

from tests.cogs.black_box_cog.logbook import write_flight


@pytest.fixture
def plane(tmp_path):
    """An application whose flights are in ``elsewhere``."""
    plane = tmp_path / "plane"
    (plane / "config").mkdir(parents=True)
    (plane / "UpFile").write_text("")
    (plane / "config" / "black_box.yml").write_text(f"folder: {tmp_path}/elsewhere\n")
    write_flight(tmp_path / "elsewhere", 3)
    return plane


def test_inside_an_application_it_looks_where_its_black_box_writes(log, plane, tmp_path):
    sentence = f"there is no flight 9 in {tmp_path}/elsewhere: it has 3 only\n"
    assert log("replay", 9, cwd=plane).err == log("info", 9, cwd=plane).err == sentence
    assert log("replay", 9, "--config", plane / "config").err == sentence
    other = log("replay", 9, "--folder", tmp_path / "other", cwd=plane)
    assert f"no flight has been recorded: there is no folder {tmp_path}/other" in other.err


def test_outside_of_one_it_looks_at_the_usual_folder(log, flights):
    assert f"no flight is in {flights}" in log("replay", "last").err


def test_a_mistake_in_black_box_yml_is_told_by_its_place(log, plane):
    (plane / "config" / "black_box.yml").write_text("foldr: x\n")
    outcome = log("replay", "last", cwd=plane)
    assert outcome.status == 2 and "black_box.yml:1:1" in outcome.err
