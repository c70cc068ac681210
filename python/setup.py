"""Builds the compiled module with CMake, in the build folder of the repository."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent.parent


class BuildWithCMake(build_ext):
    """Configures the preset `release`, builds the module and puts it where setuptools wants it."""

    def build_extension(self, ext: Extension) -> None:
        # Options are kept as they are in a folder that is configured already.
        options = [] if (ROOT / "build/release/CMakeCache.txt").exists() else ["-DCAIRN_SOURCES_AT_ONCE=0"]
        options += ["-DCAIRN_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={Path(sys.base_prefix) / 'bin' / 'python3'}"]
        subprocess.run(["cmake", "--preset", "release", "--log-level=WARNING", *options], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", "--preset", "release", "--target", "cairn_python"], cwd=ROOT, check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / "build" / "release" / "python" / "cairn" / target.name, target)


def version() -> str:
    """That of the library."""
    header = (ROOT / "include" / "cairn" / "version.h").read_text(encoding="utf-8")
    found = re.search(r'version = "([^"]+)"', header)
    if found is None:
        raise RuntimeError("include/cairn/version.h names no version")
    return found[1]


# Where setup.cfg has everything built.
(ROOT / "build" / "python").mkdir(parents=True, exist_ok=True)
setup(version=version(), ext_modules=[Extension("cairn._core", sources=[])], cmdclass={"build_ext": BuildWithCMake})
