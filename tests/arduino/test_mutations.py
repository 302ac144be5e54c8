"""The table of mutations fits the firmware: each text is there once, each test exists."""

import shutil

import pytest

from tests.arduino.mutate import HOST, ROOT, TESTS, apply, mutations


@pytest.mark.parametrize("entry", mutations(), ids=lambda entry: entry["rule"])
def test_a_mutation_fits_sources_and_tests(entry, tmp_path):
    source = shutil.copytree(ROOT / "arduino" / "raspilot" / "src", tmp_path / "src")
    apply(entry, source)
    file, name = entry["test"].split("::")
    if file.startswith(HOST):
        assert f'\nTEST_CASE("{name}") {{' in (ROOT / "arduino" / file).read_text(encoding="utf-8")
    else:
        assert f"\ndef {name.split('[')[0]}(" in (TESTS / file).read_text(encoding="utf-8")
