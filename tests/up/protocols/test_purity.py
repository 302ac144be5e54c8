import subprocess
import sys
from pathlib import Path

import up.protocols

FOLDER = Path(up.protocols.__file__).parent
MODULES = sorted(f"up.protocols.{path.stem}" for path in FOLDER.glob("*.py"))
CODECS = ("checked_framing", "framing", "line_decoder",
          "general_message", "orientation_forward")  # fmt: skip


def loaded_after(imports):
    code = f"import sys, {', '.join(imports)}; print(*sys.modules, sep='\\n')"
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, check=True, text=True
    )
    return result.stdout.split()


def test_no_transport_imports_the_reactor():
    loaded = loaded_after(MODULES)
    assert "twisted.internet.protocol" in loaded
    assert "twisted.internet.reactor" not in loaded


def test_no_codec_imports_twisted():
    loaded = loaded_after([f"up.protocols.{name}" for name in CODECS])
    assert not [name for name in loaded if name.startswith("twisted")]
