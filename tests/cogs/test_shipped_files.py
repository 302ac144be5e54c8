"""The files that the cogs ship: templates, manifests, examples."""

import importlib
import re
from pathlib import Path

import pytest
from android_cog.config import ANDROID
from black_box_cog.config import BLACK_BOX
from crsf_cog.config import CRSF
from discovery_cog.config import DISCOVERY
from gps_cog.config import GPS
from mavlink_cog.config import MAVLINK
from metrics_cog.config import METRICS
from mission_control_cog.config import MISSION_CONTROL
from msp_cog.config import MSP
from msp_cog.osd_config import OSD
from sensors_cog.config import SENSORS
from serial_cog.config import ARDUINO

from up.base_module import BaseModule
from up.cogs.manifest import load_manifest
from up.config import ConfigErrors
from up.flight_controller.pids_file import PIDS
from up.flight_controller.profile_wire import AIRFRAME

ROOT = Path(__file__).parents[2]


FILES = [
    ANDROID,
    ARDUINO,
    BLACK_BOX,
    CRSF,
    DISCOVERY,
    GPS,
    MAVLINK,
    METRICS,
    MISSION_CONTROL,
    MSP,
    OSD,
    PIDS,
    SENSORS,
    AIRFRAME,
]
COGS = sorted(path.name for path in (ROOT / "cogs").glob("*_cog"))


@pytest.mark.parametrize("file", FILES, ids=lambda f: f.filename)
def test_the_shipped_configuration_is_the_template(file):
    assert (ROOT / "config" / file.filename).read_text(encoding="utf-8") == file.template()
    assert file.load(ROOT / "config") == file.cls()


def test_the_tuning_example_grants_a_pilot_and_accepts_no_public_link():
    values = MISSION_CONTROL.load(ROOT / "config" / "examples" / "tuning")
    assert (values.role, values.i_accept_plain, values.listener.port) == ("pilot", False, 50002)


@pytest.mark.parametrize("cog", COGS)
def test_the_manifest_names_every_module_of_the_cog(cog):
    registrant = importlib.import_module(f"{cog}.registrar").Registrant()
    assert registrant.cog_name == cog
    entries = load_manifest(registrant.folder, cog).modules
    for entry in entries:
        cls = getattr(importlib.import_module(entry.prefix), entry.class_name)
        assert issubclass(cls, BaseModule)
    files = {path.stem for path in (registrant.folder / "modules").glob("[!_]*.py")}
    assert files == {entry.prefix.rpartition(".")[2] for entry in entries}


@pytest.mark.parametrize(
    ("file", "text", "says"),
    [
        (ANDROID, "general port: 5\norientation port: 5\n", "must differ from the general port"),
        (ANDROID, "port: 5\n", "is called 'general port' now"),
        (ANDROID, "stop delay (in seconds): 5\n", "stop delay (s)"),
        (ANDROID, "address: phone.local\n", "must be a literal IP address"),
        (MISSION_CONTROL, "aircraft: my plane\n", "must be 1 to 32 letters"),
        (MISSION_CONTROL, "remote_server: {url: 'http://x/'}\n", "a host name or an address alone"),
        (MISSION_CONTROL, "role: admin\n", '"observer", "operator", "pilot"'),
        (MISSION_CONTROL, "listener: {port: 50002, address: here}\n", "literal IP address"),
        (BLACK_BOX, "folder: flights\n", "must be an absolute path, or begin with ~/"),
        (BLACK_BOX, "folder: ~nobody.at.all/x\n", "names a user"),
        (BLACK_BOX, 'folder: "/a\\0b"\n', "must be an absolute path"),
        (BLACK_BOX, "total size (MB): 99\n", "must be at least twice the file size"),
        (BLACK_BOX, "sync (s): 0.1\n", "sync (s)"),
        (DISCOVERY, "port: 70000\n", "65535"),
    ],
)
def test_what_cannot_be_meant_is_refused(file, text, says):
    with pytest.raises(ConfigErrors, match=re.escape(says)):
        file.parse(text, Path(file.filename))
