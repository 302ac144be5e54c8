"""The state that a runner saves for the next one."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_runner import instance_state
from up_runner.instance_state import InstanceState
from up_runner.process import Identity
from up_runner.request import Request

FULL = InstanceState(
    Request("glider-1", "cub", {"load_guard.yml": {"interval": 1.5}}, key="0011223344556677"),
    Identity(4242, 123456, "b007"),
    keep=True,
    ready=True,
    ports={"general": 50001},
    phone=False,
)


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / "glider-1"
    made.mkdir()
    return made


@pytest.mark.parametrize(
    "kept", [FULL, InstanceState(Request("glider-1")), InstanceState(FULL.request, keep=True)]
)
def test_it_reads_back(folder, kept):
    kept.save(folder)
    assert instance_state.load(folder) == kept
    assert [path.name for path in folder.iterdir()] == ["state.json"]


def test_without_a_file_there_is_no_state(folder):
    assert instance_state.load(folder) is None
    instance_state.discard(folder)


def test_discarded_it_is_gone(folder):
    FULL.save(folder)
    instance_state.discard(folder)
    assert instance_state.load(folder) is None


def test_the_file_of_another_instance_is_ignored(tmp_path, folder):
    FULL.save(folder)
    (tmp_path / "other").mkdir()
    (folder / "state.json").rename(tmp_path / "other" / "state.json")
    assert instance_state.load(tmp_path / "other") is None


def test_no_changed_byte_breaks_it(folder):
    FULL.save(folder)
    path = folder / "state.json"
    data = path.read_bytes()
    for position in range(len(data)):
        for byte in (0x00, 0x22, 0x30, 0x7B, 0xFF):
            path.write_bytes(data[:position] + bytes([byte]) + data[position + 1 :])
            instance_state.load(folder)
        path.write_bytes(data[:position])
        assert instance_state.load(folder) is None or position == len(data) - 1


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
)


@given(st.sampled_from(["request", "process", "keep", "ready", "ports", "phone"]), json_values)
def test_no_wrong_type_breaks_it(tmp_path_factory, key, value):
    folder = tmp_path_factory.mktemp("state") / "glider-1"
    folder.mkdir()
    FULL.save(folder)
    state = json.loads((folder / "state.json").read_text())
    state[key] = value
    (folder / "state.json").write_text(json.dumps(state))
    found = instance_state.load(folder)
    assert found is None or isinstance(found, InstanceState)
