"""Checks a finished APK against its manifest and the promises of its Makefile.

``verify.py APK MANIFEST VERSION LIMIT``: package and levels, the version, permissions exactly as in
the manifest (none implied), no required features, no native code, a readable dex, and its size.
``verify.py code VERSION`` prints the version as the number that Android compares.
"""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Iterator
from pathlib import Path

PACKAGE = "org.raspilot"
LEAST_SDK = "16"
TARGET_SDK = "29"
NAME = "{http://schemas.android.com/apk/res/android}name"
# aapt implies a touch screen for every app unless its manifest declares it optional.
HARMLESS = {"android.hardware.faketouch", "android.hardware.touchscreen"}


def version_code(version: str) -> int:
    """Return a number that increases with the version: 1.2.3 is 10203."""
    major, minor, patch = (int(each) for each in version.split("."))
    return major * 10000 + minor * 100 + patch


def promised(manifest: Path) -> list[str]:
    """Return the permissions in the text of a manifest."""
    root = ElementTree.parse(manifest).getroot()
    return sorted(each.get(NAME, "") for each in root.iter("uses-permission"))


def badging(apk: Path) -> str:
    """Return the output of ``aapt dump badging`` for an APK."""
    command = ["aapt", "dump", "badging", str(apk)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def faults(said: str, asked: list[str], version: str) -> Iterator[str]:
    """Yield one sentence for every error in the badging."""
    expected = {
        f"package: name='{PACKAGE}'": rf"package: name='{re.escape(PACKAGE)}' ",
        f"versionCode='{version_code(version)}'": rf" versionCode='{version_code(version)}' ",
        f"versionName='{version}'": rf" versionName='{re.escape(version)}'",
        f"sdkVersion:'{LEAST_SDK}'": rf"(?m)^sdkVersion:'{LEAST_SDK}'$",
        f"targetSdkVersion:'{TARGET_SDK}'": rf"(?m)^targetSdkVersion:'{TARGET_SDK}'$",
        "launchable-activity": r"(?m)^launchable-activity: ",
    }
    for words, pattern in expected.items():
        if not re.search(pattern, said):
            yield f"the APK does not say {words}"
    given = sorted(re.findall(r"(?m)^uses-permission(?:-sdk-23)?: name='([^']*)'", said))
    if given != asked:
        differing = ", ".join(sorted(set(given) ^ set(asked))) or "one is asked for twice"
        yield f"the permissions are not those of the manifest: {differing}"
    for implied in re.findall(r"(?m)^\s*uses-implied-permission: name='([^']*)'", said):
        yield f"the permission {implied} is asked for by implication: name it, or do without"
    for kind, feature in re.findall(r"(?m)^\s*(uses(?:-implied)?-feature): name='([^']*)'", said):
        if feature not in HARMLESS:
            yield f'a phone must have {feature} ({kind}): say android:required="false"'
    if "native-code" in said:
        yield "the APK holds native code"


def dex_fault(apk: Path) -> str | None:
    """Return the faults that ``dexdump`` finds in the code's checksum and structure, or None."""
    checked = subprocess.run(["dexdump", "-c", str(apk)], capture_output=True, text=True)
    read = subprocess.run(["dexdump", "-f", str(apk)], capture_output=True, text=True)
    if checked.returncode != 0 or "Checksum verified" not in checked.stdout:
        return f"dexdump does not verify the code: {(checked.stderr or checked.stdout).strip()}"
    if read.returncode != 0:
        return f"dexdump cannot read the code: {read.stderr.strip()}"
    return None


def main(arguments: list[str]) -> int:
    """Check the APK that ``arguments`` name; print its size; return the exit status."""
    if arguments[0] == "code":
        print(version_code(arguments[1]))
        return 0
    apk, manifest, version, limit = Path(arguments[0]), Path(arguments[1]), *arguments[2:]
    found = list(faults(badging(apk), promised(manifest), version))
    with zipfile.ZipFile(apk) as opened:
        native = [each for each in opened.namelist() if each.endswith(".so")]
        code = opened.getinfo("classes.dex")
    found += [f"the APK holds native code: {each}" for each in native]
    if fault := dex_fault(apk):
        found.append(fault)
    size = apk.stat().st_size
    print(
        f"{apk.name} {size} bytes of {limit} (code {code.compress_size}, {code.file_size} unpacked)"
    )
    if size > int(limit):
        found.append(f"the APK has {size} bytes: over its target of {limit}")
    for each in found:
        print(f"{apk}: {each}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
