"""The shipped files of the serial and the Arduino cog."""

import importlib
from pathlib import Path

import pytest
from arduino_cog.profile import AIRFRAME

from up.base_module import BaseModule
from up.cogs.manifest import load_manifest
from up.flight_controller.pids_file import PIDS

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("file", [PIDS, AIRFRAME], ids=lambda file: file.filename)
def test_the_shipped_file_is_the_template(file):
    assert (ROOT / "config" / file.filename).read_text(encoding="utf-8") == file.template()


@pytest.mark.parametrize("cog", ["serial_cog", "arduino_cog"])
def test_the_manifest_names_every_module_of_the_cog(cog):
    registrant = importlib.import_module(f"{cog}.registrar").Registrant()
    assert registrant.cog_name == cog
    entries = load_manifest(registrant.folder, cog).modules
    for entry in entries:
        cls = getattr(importlib.import_module(entry.prefix), entry.class_name)
        assert issubclass(cls, BaseModule)
    files = {path.stem for path in (registrant.folder / "modules").glob("[!_]*.py")}
    assert files == {entry.prefix.rpartition(".")[2] for entry in entries}
