"""The claims of an APK are compared with its manifest and with the project's promises."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from tests.support.android import ANDROID, make, need_android

sys.path.insert(0, str(ANDROID / "tools"))
import verify

FIXTURE = Path(__file__).parents[1] / "fixtures" / "android_app" / "raspilot"
PERMISSION = '<uses-permission android:name="android.permission.{}" />\n    <application'


def faults(folder, old="", new="", version="0.1.0", asked=None):
    """Compile the fixture's resources with its manifest changed; return the findings."""
    need_android()
    shutil.copytree(FIXTURE, folder / "raspilot")
    manifest = folder / "raspilot" / "AndroidManifest.xml"
    text = manifest.read_text()
    assert old in text
    manifest.write_text(text.replace(old, new) if old else text)
    build = folder / "build"
    make(f"RASPILOT={folder / 'raspilot'}", f"BUILD={build}", f"{build}/resources.apk")
    promised = verify.promised(manifest) if asked is None else asked
    found = verify.faults(verify.badging(build / "resources.apk"), promised, version)
    return [(each.code, each.subject) for each in found]


def test_the_fixture_is_as_promised(tmp_path):
    assert faults(tmp_path) == []


def test_another_version_is_found(tmp_path):
    assert ("badging", "versionCode='10203'") in faults(tmp_path, version="1.2.3")


def test_a_permission_that_is_not_promised_is_found(tmp_path):
    assert faults(tmp_path, asked=[]) == [("permissions", "android.permission.INTERNET")]


def test_a_permission_that_is_missing_is_found(tmp_path):
    found = faults(tmp_path, asked=["android.permission.INTERNET", "android.permission.VIBRATE"])
    assert found == [("permissions", "android.permission.VIBRATE")]


def test_an_implied_permission_is_found(tmp_path):
    found = faults(tmp_path, "<application", PERMISSION.format("WRITE_EXTERNAL_STORAGE"))
    assert ("implied", "android.permission.READ_EXTERNAL_STORAGE") in found


def test_a_feature_that_a_phone_must_have_is_found(tmp_path):
    found = faults(tmp_path, "<application", PERMISSION.format("ACCESS_FINE_LOCATION"))
    assert ("feature", "android.hardware.location") in found


def test_a_manifest_that_says_other_levels_is_found(tmp_path):
    sdk = '<uses-sdk android:minSdkVersion="21" android:targetSdkVersion="28" />\n    <application'
    found = faults(tmp_path, "<application", sdk)
    assert {("badging", "sdkVersion:'16'"), ("badging", "targetSdkVersion:'29'")} <= set(found)


def test_the_version_is_a_number_that_rises():
    codes = [verify.version_code(each) for each in ("0.1.0", "0.1.1", "0.2.0", "1.0.0")]
    assert codes == [100, 101, 200, 10000]
