"""The Java phone is found, rebuilt when its sources are newer, and replaced where unavailable."""

import os
import shutil

import pytest

from tests.simulator.program import Program
from tests.support.java import java_program, path_without
from up_simulator.harness.participants import ParticipantError
from up_simulator.phone.java_program import (
    ANDROID,
    IN_JAVA,
    IN_PYTHON,
    PACKAGE,
    JavaUnavailableError,
    choose_phone,
    find_java_program,
)

CORE = "package one;\n/** One. */\npublic final class One {\n    private One() {}\n}\n"


@pytest.fixture
def android(tmp_path):
    """A project of two classes with the real Makefile."""
    java_program()
    folder = tmp_path / "android"
    (folder / "core" / "src").mkdir(parents=True)
    (folder / "virtual" / "src").mkdir(parents=True)
    shutil.copy(ANDROID / "Makefile", folder)
    shutil.copytree(ANDROID / "tools", folder / "tools")
    (folder / "core" / "src" / "One.java").write_text(CORE)
    (folder / "virtual" / "src" / "Two.java").write_text(CORE.replace("One", "Two"))
    return folder


def built_ns(program):
    return [jar.stat().st_mtime_ns for jar in program.jars]


def test_it_is_rebuilt_when_a_source_is_newer_or_removed(android):
    first = built_ns(find_java_program(android=android))
    program = find_java_program(android=android)
    assert built_ns(program) == first
    source = android / "virtual" / "src" / "Two.java"
    newer_ns = max(first) + 2_000_000_000
    os.utime(source, ns=(newer_ns, newer_ns))
    second = built_ns(find_java_program(android=android))
    assert all(new > old for new, old in zip(second, first, strict=True))
    (android / "core" / "src" / "One.java").rename(android / "core" / "src" / "Other.java")
    (android / "core" / "src" / "Other.java").write_text(CORE.replace("One", "Other"))
    assert built_ns(find_java_program(android=android)) != second


def test_a_compiler_error_is_reported_in_one_line(android):
    (android / "core" / "src" / "One.java").write_text(CORE.replace("class", "clasp"))
    with pytest.raises(JavaUnavailableError, match=r"One\.java:3: error:") as caught:
        find_java_program(android=android)
    assert "\n" not in str(caught.value)


def test_without_a_compiler_an_earlier_build_is_used_and_reported(android, tmp_path, monkeypatch):
    find_java_program(android=android)
    newer_s = (android / "build" / "up-core.jar").stat().st_mtime + 2
    os.utime(android / "core" / "src" / "One.java", (newer_s, newer_s))
    monkeypatch.setenv("PATH", path_without(tmp_path / "bin", "javac"))
    logged = []
    find_java_program(lambda _text, **fields: logged.append(fields), android)
    assert logged == [{"code": "phone_outdated"}]
    shutil.rmtree(android / "build")
    with pytest.raises(JavaUnavailableError, match="javac"):
        find_java_program(android=android)


def test_without_sources_or_java_it_is_unavailable(tmp_path, monkeypatch):
    java_program()
    with pytest.raises(JavaUnavailableError, match="nowhere"):
        find_java_program(android=tmp_path / "nowhere")
    monkeypatch.setenv("PATH", path_without(tmp_path / "bin", "java"))
    with pytest.raises(JavaUnavailableError, match=PACKAGE):
        find_java_program()


def test_auto_is_java_where_available_and_otherwise_python(tmp_path, monkeypatch):
    java_program()
    assert choose_phone().java == choose_phone("java").java == find_java_program()
    assert choose_phone().title == IN_JAVA
    assert choose_phone("python").java is None and choose_phone("python").title == IN_PYTHON
    monkeypatch.setenv("PATH", path_without(tmp_path / "bin", "java"))
    choice = choose_phone()
    assert choice.java is None and PACKAGE in choice.title
    with pytest.raises(ParticipantError, match=PACKAGE):
        choose_phone("java")


def test_an_aircraft_without_java_flies_the_stub(tmp_path):
    path = {"PATH": path_without(tmp_path / "bin", "java")}
    with Program("--no-board", "--general-port", "1", environment=path) as program:
        assert PACKAGE in program.wait_for("phone_selected").fields["phone"]
        program.wait_for("phone_not_connected", port=1)
        assert program.end()[0] == 0
    with Program("--no-board", "--phone", "java", environment=path) as program:
        assert program.process.wait(60) == 1
        assert PACKAGE in program.error()
