"""What `config/` ships: templates as they are, and Black Box Mode ready-made."""

from pathlib import Path

import pytest
import yaml
from android_cog.config import ANDROID, AndroidConfig
from load_guard_cog.config import LOAD_GUARD
from mission_control_cog.config import MISSION_CONTROL

from up.config.application import APPLICATION, DISABLED_MODULES, PROVIDERS, ApplicationConfig
from up_cluster.config import FLEET
from up_proxy.config import PROXY

CONFIG = Path(__file__).parents[1] / "config"
BLACK_BOX = CONFIG / "blackbox"


@pytest.mark.parametrize(
    "file",
    [APPLICATION, DISABLED_MODULES, PROVIDERS, PROXY, FLEET, LOAD_GUARD],
    ids=lambda f: f.filename,
)
def test_the_shipped_file_is_the_template(file):
    assert (CONFIG / file.filename).read_text(encoding="utf-8") == file.template()
    assert file.load(CONFIG) == file.cls()


def test_black_box_mode_differs_from_the_defaults_by_its_mode_and_ports():
    assert APPLICATION.load(BLACK_BOX) == ApplicationConfig(mode="black box")
    for file in (DISABLED_MODULES, PROVIDERS, LOAD_GUARD, MISSION_CONTROL):
        assert file.load(BLACK_BOX) == file.cls()


def test_black_boxes_take_any_ports_so_that_several_fly_from_one_server():
    assert ANDROID.load(BLACK_BOX) == AndroidConfig(general_port=0, orientation_port=0)


def test_every_shipped_key_has_a_comment():
    for path in sorted(CONFIG.rglob("*.yml")):
        if path.parent.name == "tuning":
            continue
        lines = path.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines):
            if line and not line.startswith((" ", "#", "-")):
                before = [each for each in lines[:number] if each.strip()]
                assert before and before[-1].lstrip().startswith("#"), f"{path}:{number + 1}"
        assert yaml.safe_load(path.read_text(encoding="utf-8")) is not None, path
