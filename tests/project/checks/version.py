"""include/cairn/version.h and CMakeLists.txt name the same version."""

import re
from pathlib import Path


def check(root: Path) -> list[str]:
    header = re.search(r'version = "([^"]+)"', (root / "include/cairn/version.h").read_text(encoding="utf-8"))
    project = re.search(r"project\(cairn VERSION (\S+)", (root / "CMakeLists.txt").read_text(encoding="utf-8"))
    if header.group(1) == project.group(1):
        return []
    return [f"version.h says {header.group(1)}, CMakeLists.txt says {project.group(1)}"]
