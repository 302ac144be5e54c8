from tools.import_contracts import names_in_up


def test_up_names_no_cog_and_no_device():
    assert list(names_in_up()) == []


def test_a_name_is_found_and_an_allowed_text_is_not(tmp_path):
    folder = tmp_path / "up"
    folder.mkdir()
    (folder / "mode.py").write_text("WITH_ARDUINO = 1\n# the Phone, serial-cog\n")
    found = list(names_in_up(tmp_path))
    assert found == ["up/mode.py:2: Phone", "up/mode.py:2: serial-cog"]
