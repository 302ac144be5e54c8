import itertools
import json
import os
import stat
from dataclasses import dataclass, replace

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.up.config.samples import LINK, PATH, Gains, Link, Remote
from up.config import ConfigFile, items, mapping, section, write_schemas, write_template
from up.config.application import (
    APPLICATION,
    DISABLED_MODULES,
    ApplicationConfig,
    DisabledModulesConfig,
)
from up.config.schema import ListOf
from up.fields import Constraint

FILES = [LINK, APPLICATION, DISABLED_MODULES]
ANY_TEXT = st.text(st.characters(exclude_categories=("Cs",)), max_size=20)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.filename)
def test_a_template_holds_exactly_the_defaults(file):
    assert file.parse(file.template(), PATH) == file.cls()


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.filename)
def test_a_template_names_every_key_and_is_easy_to_read(file):
    template = file.template()
    assert template.startswith("# ")
    assert template.endswith("\n")
    assert all(len(line) <= 78 for line in template.splitlines())
    assert list(yaml.safe_load(template)) == [
        entry.name
        for entry in file.schema.entries
        if entry.default is not None or entry.name == "limit"
    ]


def test_a_template_tells_unit_range_choices_and_default():
    assert "# Unit: s. Range: 0 to 3600. Default: 10.0.\nstop delay (s): 10.0\n" in LINK.template()
    assert "# One of: observer, operator, pilot. Default: operator.\n" in LINK.template()
    assert "  # Range: 1 to 65535. Default: 3003.\n  port: 3003\n" in LINK.template()


def test_an_absent_section_stands_there_to_be_uncommented():
    template = LINK.template()
    commented = '# spare server:\n#   url: ""\n#   port: 3003\n'
    assert commented in template
    shown = template.replace(commented, commented.replace("# ", ""))
    assert LINK.parse(shown, PATH) == replace(Link(), spare=Remote())


@settings(deadline=None)
@given(
    url=ANY_TEXT,
    delay=st.floats(0, 3600),
    limit=st.none() | st.floats(0, allow_infinity=False),
    names=st.dictionaries(ANY_TEXT, st.integers(0, 9), max_size=4),
    hosts=st.lists(ANY_TEXT, max_size=5),
    p=st.floats(0, 50),
    spare=st.booleans(),
)
def test_what_is_rendered_is_read_back_the_same(url, delay, limit, names, hosts, p, spare):
    values = Link(
        remote_server=Remote(url, 1),
        stop_delay_s=delay,
        limit=limit,
        labels=names,
        hosts=tuple(hosts),
        gains={"a": Gains(p=p)},
        spare=Remote(url) if spare else None,
    )
    text = LINK.render(values)
    assert LINK.parse(text.encode(), PATH) == values
    # An ordinary YAML reader understands the same.
    other = yaml.safe_load(text)
    assert other["remote_server"]["url"] == url
    assert other["stop delay (s)"] == delay
    assert other["labels"] == names


def test_numbers_that_are_not_finite_are_not_written():
    with pytest.raises(ValueError, match="nan"):
        LINK.render(replace(Link(), stop_delay_s=float("nan")))


def test_a_schema_tells_what_a_file_may_hold():
    schema = LINK.json_schema()
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert schema["title"] == "link.yml"
    assert schema["description"] == LINK.schema.comment
    assert schema["additionalProperties"] is False
    port = schema["properties"]["remote_server"]["properties"]["port"]
    assert port.pop("description")
    assert port == {"type": "integer", "minimum": 1, "maximum": 65535, "default": 3003}
    assert schema["properties"]["hosts"] == {
        "type": "array",
        "items": {"type": "string"},
        "maxItems": 5,
        "description": schema["properties"]["hosts"]["description"],
        "default": ["127.0.0.1", "::1"],
    }
    assert schema["properties"]["gains"]["additionalProperties"]["additionalProperties"] is False
    assert schema["properties"]["limit"]["default"] is None
    assert "default" not in schema["properties"]["spare server"]


def test_schemas_are_written_for_editors(tmp_path):
    paths = write_schemas(FILES, tmp_path / "schemas")
    assert [path.name for path in paths] == [
        "link.schema.json",
        "config.schema.json",
        "disabled_modules.schema.json",
    ]
    for file, path in zip(FILES, paths, strict=True):
        assert json.loads(path.read_text()) == file.json_schema()
    assert write_schemas(FILES, tmp_path / "schemas") == paths
    assert sorted(path.name for path in (tmp_path / "schemas").iterdir()) == sorted(
        path.name for path in paths
    )


def test_a_template_is_written_into_a_new_folder_and_never_again(tmp_path):
    folder = tmp_path / "a" / "config"
    assert write_template(LINK, folder) is True
    path = folder / "link.yml"
    assert path.read_text() == LINK.template()
    path.write_text("role: pilot\n")
    assert write_template(LINK, folder) is False
    assert path.read_text() == "role: pilot\n"
    assert [found.name for found in folder.iterdir()] == ["link.yml"]


def test_a_template_respects_the_umask(tmp_path):
    before = os.umask(0o027)
    try:
        write_template(LINK, tmp_path)
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "link.yml").stat().st_mode) == 0o640


@pytest.mark.parametrize("race", [False, True])
def test_a_dangling_link_is_not_written_through(tmp_path, monkeypatch, race):
    (tmp_path / "link.yml").symlink_to(tmp_path / "elsewhere")
    if race:
        # As if the link had appeared after the first look.
        monkeypatch.setattr(os.path, "lexists", lambda path: False)
    assert write_template(LINK, tmp_path) is False
    assert not (tmp_path / "elsewhere").exists()
    assert [found.name for found in tmp_path.iterdir()] == ["link.yml"]


@pytest.mark.parametrize("taken", [False, True])
def test_a_file_system_without_hard_links_will_do(tmp_path, monkeypatch, taken):
    def no_link(source, target):
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", no_link)
    monkeypatch.setattr(os.path, "lexists", lambda path: False)
    if taken:
        (tmp_path / "link.yml").write_text("mine")
    assert write_template(LINK, tmp_path) is not taken
    assert (tmp_path / "link.yml").read_text() == ("mine" if taken else LINK.template())
    assert [found.name for found in tmp_path.iterdir()] == ["link.yml"]


def test_the_application_file_takes_old_and_new_spellings():
    old = APPLICATION.parse("log level: INFO\n", PATH)
    assert old == ApplicationConfig()
    assert APPLICATION.parse("mode: black box\nflight controller: raspberry\n", PATH) == (
        ApplicationConfig(mode="black box", flight_controller="raspberry")
    )


@pytest.mark.parametrize(
    ("text", "modules"),
    [
        ("disabled modules:\n", ()),
        ("disabled modules: null\n", ()),
        ("disabled modules:\n- a.b.C\n- d.E\n", ("a.b.C", "d.E")),
    ],
)
def test_disabled_modules_may_be_empty_or_a_list(text, modules):
    assert DISABLED_MODULES.parse(text, PATH) == DisabledModulesConfig(modules)


def test_a_file_without_keys_has_a_template_too():
    @dataclass(frozen=True)
    class Nothing:
        """Nothing yet."""

    @dataclass(frozen=True)
    class Outer:
        inner: Nothing = section(Nothing)

    for cls in (Nothing, Outer):
        file = ConfigFile("x.yml", cls)
        assert file.parse(file.template(), PATH) == cls()


def test_a_dataclass_without_a_docstring_has_no_head():
    @dataclass(frozen=True)
    class Silent:
        inner: Remote = section(Remote, "Said here.")

    template = ConfigFile("x.yml", Silent).template()
    assert template.startswith("# Said here.\ninner:\n")
    assert not any(a == b == "" for a, b in itertools.pairwise(template.splitlines()))


def test_lists_of_maps_and_maps_of_lists_are_rendered_and_read_back():
    @dataclass(frozen=True)
    class Nested:
        remotes: tuple = items(Remote, "All of them.", default=(Remote("a, b", 1), Remote()))
        groups: dict = mapping(
            Constraint(str), ListOf(Constraint(str), 3), "By name.", default={"no": ("x", "1.5")}
        )

    file = ConfigFile("x.yml", Nested)
    assert file.parse(file.template(), PATH) == Nested()
    assert file.parse("remotes: []\ngroups: {}\n", PATH) == Nested((), {})
    assert yaml.safe_load(file.template()) == {
        "remotes": [{"url": "a, b", "port": 1}, {"url": "", "port": 3003}],
        "groups": {"no": ["x", "1.5"]},
    }
    assert '# For example  - {url: "", port: 3003}\n' in file.template()
