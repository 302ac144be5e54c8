"""Raspilot's own cogs go the same road as a stranger's."""

import shutil

from tests.support.program_output import AS_JSON, fields_of
from tests.support.virtual_environment import REPOSITORY
from up.cogs.cogfile import load_cogfile

LEFT_OUT = shutil.ignore_patterns("__pycache__", "*.egg-info", "external_modules.yml", "build")


def test_every_cog_of_raspilot_is_gathered_from_the_tree(environment, tmp_path):
    for name in ("raspilot", "cogs", "config"):
        shutil.copytree(REPOSITORY / name, tmp_path / name, ignore=LEFT_OUT)
    wanted = [each.cog for each in load_cogfile(tmp_path / "raspilot")]
    assert wanted == [
        "serial_cog",
        "arduino_cog",
        "android_cog",
        "discovery_cog",
        "load_guard_cog",
        "mission_control_cog",
        "black_box_cog",
    ]
    done = environment.up("gather", cwd=tmp_path, environ=AS_JSON)
    assert fields_of(done.stdout)[-1] == {"code": "gathered", "count": len(wanted)}
    for mode in ("auto", "black box"):
        environment.up("check", "--mode", mode, cwd=tmp_path)
    black_box = environment.up("modules", "--mode", "black box", cwd=tmp_path).stdout
    loaded, _, left_out = black_box.partition("not loaded:")
    for cog in ("serial_cog.", "arduino_cog.", "discovery_cog."):
        assert cog not in loaded and cog in left_out
    assert "android_cog." in loaded
