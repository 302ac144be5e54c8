import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from up.cogs.source_tree import builds_with_setuptools, distribution_name, neighbours, normal_name


@pytest.mark.parametrize(
    ("files", "name"),
    [
        ({"setup.py": "from setuptools import setup\nsetup(name='a-cog')\n"}, "a-cog"),
        ({"setup.py": "import setuptools\nsetuptools.setup(name='a')\n"}, "a"),
        ({"setup.py": "raise SystemExit\nsetup(name='a')\n"}, "a"),
        ({"setup.py": "setup(name=NAME)\n"}, ""),
        ({"setup.py": "setup(name='--index-url x')\n"}, ""),
        ({"setup.py": "setup(\n"}, ""),
        ({"setup.py": "print('no setup')\n"}, ""),
        ({"pyproject.toml": "[project]\nname = 'b'\n", "setup.py": "setup(name='a')\n"}, "b"),
        ({"pyproject.toml": "[project\n", "setup.py": "setup(name='a')\n"}, "a"),
        ({"pyproject.toml": "project = 1\n"}, ""),
        ({}, ""),
    ],
)
def test_the_name_of_the_distribution(tmp_path, files, name):
    for file, text in files.items():
        (tmp_path / file).write_text(text)
    assert distribution_name(tmp_path) == name


@pytest.mark.parametrize(
    ("text", "is_setuptools"),
    [
        ("", True),
        ("[build-system]\nrequires = ['setuptools']\n", True),
        ("[build-system]\nbuild-backend = 'setuptools.build_meta'\n", True),
        ("[build-system]\nbuild-backend = 'hatchling.build'\n", False),
    ],
)
def test_what_builds_it(tmp_path, text, is_setuptools):
    assert builds_with_setuptools(tmp_path)
    (tmp_path / "pyproject.toml").write_text(text)
    assert builds_with_setuptools(tmp_path) is is_setuptools


@given(text=st.text())
@example("(" * 5000)
@example("-" * 5000 + "1")
@example("a = " + "[" * 5000)
@example("setup(name='a\\0')")
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
def test_no_content_raises(tmp_path, text):
    data = text.encode("utf-8", "surrogatepass")
    for file in ("setup.py", "pyproject.toml"):
        (tmp_path / file).write_bytes(data)
    assert isinstance(distribution_name(tmp_path), str)
    assert isinstance(builds_with_setuptools(tmp_path), bool)


def test_neighbours_are_known_by_normal_names(tmp_path):
    for folder, name in (("a", "Raspilot_A.Cog"), ("b", "b"), ("c", "")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "setup.py").write_text(f"setup(name={name!r})\n")
    (tmp_path / "file").write_text("")
    assert neighbours(tmp_path / "b") == {
        "raspilot-a-cog": tmp_path / "a",
        "b": tmp_path / "b",
    }
    assert normal_name("A_b.C") == "a-b-c"
