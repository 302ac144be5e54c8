"""A small app is built, signed and verified; a fault in it stops the build with its name."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.support.android import ANDROID, JARS, AndroidBuildError, lay_out, make, need_android

sys.path.insert(0, str(ANDROID / "tools"))
import verify

FIXTURE = Path(__file__).parents[1] / "fixtures" / "android_app"
ACTIVITY = Path("raspilot/src/org/raspilot/app/MainActivity.java")
ASKING = Path("library/src-23/org/raspilot/up/android/api23/Asking.java")
GREETING = Path("core/src/org/raspilot/up/Greeting.java")


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    need_android()
    folder = lay_out(tmp_path_factory.mktemp("app"), FIXTURE)
    said = make(f"JARS={JARS}", folder=folder)
    return folder, said


@pytest.fixture
def app(built, tmp_path):
    """A copy that has been built already: a mutation builds again what it touches."""
    copy = tmp_path / "copy"
    shutil.copytree(built[0].parent, copy, symlinks=True)
    return copy / "android"


def mutate(app, path, old, new):
    file = app / path
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def fails(app, *arguments, env=None):
    with pytest.raises(AndroidBuildError) as failure:
        make(f"JARS={JARS}", *arguments, folder=app, env=env)
    return str(failure.value)


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_it_is_signed_in_three_ways_and_told_with_its_size(built):
    _, said = built
    for scheme in ("v1 scheme", "v2 scheme", "v3 scheme"):
        assert any(scheme in line and line.endswith("true") for line in said.splitlines())
    assert "raspilot.apk " in said and " bytes of 420000" in said
    assert said.rstrip().endswith(f"adb install -r {built[0]}/build/raspilot.apk")


def test_what_is_built_is_not_built_again(app):
    said = make(f"JARS={JARS}", folder=app)
    assert "compile" not in said and "sign with" not in said
    assert "v2 scheme" in said


def test_the_same_sources_give_the_same_bytes(app):
    unsigned = app / "build" / "unsigned.apk"
    before = digest(unsigned), digest(app / "build" / "up-core.jar")
    for each in (app / "build").iterdir():
        if each.name not in ("signatures.jar", "api-16.signature", "boot-16.jar"):
            shutil.rmtree(each) if each.is_dir() else each.unlink()
    make(f"JARS={JARS}", "build/unsigned.apk", folder=app)
    assert (digest(unsigned), digest(app / "build" / "up-core.jar")) == before


def test_the_code_of_the_core_jar_is_in_the_apk(built):
    folder, _ = built
    apk = folder / "build" / "raspilot.apk"
    listed = subprocess.run(["dexdump", str(apk)], capture_output=True, text=True, check=True)
    with zipfile.ZipFile(folder / "build" / "up-core.jar") as core:
        classes = [name.removesuffix(".class") for name in core.namelist()]
    assert classes
    for name in classes:
        assert f"Class descriptor  : 'L{name};'" in listed.stdout


def test_the_compiler_stops_a_call_that_api_16_does_not_have(app):
    mutate(app, ACTIVITY, "Asking.isGiven(this, ", "0 == checkSelfPermission(")
    said = fails(app, "build/app.jar")
    assert "checkSelfPermission" in said


def test_animal_sniffer_stops_what_the_compiler_takes(app):
    objects = "java.util.Objects.toString(name)"
    mutate(app, GREETING, '"Hello " + name', objects)
    mutate(app, ASKING, "permission) ==", f"{objects.replace('name', 'permission')}) ==")
    mutate(app, ASKING, "return", "android.os.SystemProperties.get(permission);\n        return")
    mutate(app, ASKING, "return", "new android.app.NotificationChannel(null, null, 0);\n  return")
    for _ in "failed", "fails again":
        said = fails(app, "build/.guarded")
        assert said.count("String java.util.Objects.toString(Object)") == 2
        assert "String android.os.SystemProperties.get(String)" in said
        assert "android.app.NotificationChannel" in said


def test_a_guard_that_is_too_old_stops_it(app):
    mutate(app, ACTIVITY, "SDK_INT >= 23", "SDK_INT >= 22")
    assert "api23.Asking" in fails(app, "build/.guarded")


def test_what_resources_must_not_name_is_checked_with_the_code(app):
    (app / "raspilot" / "res" / "values" / "strings.xml").touch()
    assert "tools/resources.py raspilot/res" in make("-n", "build/.guarded", folder=app)


def test_a_missing_string_fails(app):
    mutate(app, "raspilot/res/values/strings.xml", 'name="app_name"', 'name="other"')
    assert "string/app_name" in fails(app, "build/resources.apk")


def test_a_warning_of_the_compiler_fails(app):
    mutate(app, GREETING, "return", "String same = (String) name;\n        return same +")
    assert "redundant cast" in fails(app, "core")


def test_a_warning_about_resources_fails(app):
    # A translated string without a default text: aapt only warns of it.
    folder = app / "raspilot" / "res" / "values-de"
    folder.mkdir()
    (folder / "strings.xml").write_text(
        '<resources><string name="lone">Allein</string></resources>'
    )
    assert "lone" in fails(app, "build/resources.apk")


def test_a_broken_dex_is_found(built, tmp_path):
    content = bytearray((built[0] / "build" / "classes.dex").read_bytes())
    broken = tmp_path / "classes.dex"
    broken.write_bytes(content)
    assert verify.dex_fault(broken) is None
    content[len(content) // 2] ^= 1
    broken.write_bytes(content)
    assert verify.dex_fault(broken).code == "dex"


def test_an_apk_over_its_size_fails(app):
    assert " 5000\n" in fails(app, "LIMIT=5000")


def test_a_size_that_is_no_number_is_a_sentence(app):
    said = fails(app, "LIMIT=abc")
    assert "LIMIT=abc" in said and "Traceback" not in said


def test_a_level_of_which_nothing_is_known_is_a_sentence(app):
    shutil.copytree(app / "library" / "src-23", app / "library" / "src-77")
    assert "level-77" in fails(app)


def test_a_release_key_signs(app, tmp_path):
    store = tmp_path / "release.keystore"
    subprocess.run(
        f"keytool -genkeypair -keystore {store} -storepass secret1 -alias mine"
        " -dname CN=Somebody -keyalg RSA -validity 9999".split(),
        check=True,
        capture_output=True,
    )
    key = {
        "ANDROID_KEYSTORE": str(store),
        "ANDROID_KEY_ALIAS": "mine",
        "ANDROID_KEYSTORE_PASSWORD": "secret1",
    }
    assert "key mine" in make(f"JARS={JARS}", folder=app, env=key)
    apk = str(app / "build" / "raspilot.apk")
    shown = subprocess.run(["apksigner", "verify", "--print-certs", apk], capture_output=True)
    assert b"CN=Somebody" in shown.stdout


def test_a_release_key_is_looked_for_from_where_make_was_typed(app, tmp_path):
    key = {"ANDROID_KEYSTORE": "mine.jks", "PWD": str(tmp_path)}
    assert f"{tmp_path}/mine.jks" in fails(app, env=key)


def test_a_file_that_is_no_keystore_is_a_sentence(app):
    key = {
        "ANDROID_KEYSTORE": __file__,
        "ANDROID_KEY_ALIAS": "mine",
        "ANDROID_KEYSTORE_PASSWORD": "secret1",
    }
    said = fails(app, env=key)
    assert f"mine of {__file__}" in said
    assert "\tat " not in said


@pytest.mark.parametrize(
    ("key", "named"),
    [
        ({"ANDROID_KEYSTORE": "/nowhere/x"}, "/nowhere/x"),
        ({"ANDROID_KEYSTORE": __file__}, "ANDROID_KEY_ALIAS"),
        (
            {"ANDROID_KEYSTORE": __file__, "ANDROID_KEY_ALIAS": "mine"},
            "ANDROID_KEYSTORE_PASSWORD",
        ),
    ],
)
def test_a_release_key_that_is_half_named_is_named(app, key, named):
    assert named in fails(app, env=key)
