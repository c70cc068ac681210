"""Sources are as clang-format (.clang-format) leaves them."""

import os
import re
import subprocess
from pathlib import Path

from . import tree


def check(root: Path) -> list[str]:
    run = subprocess.run([os.environ.get("CLANG_FORMAT", "clang-format"), "--dry-run", "-Werror",
                          *map(str, tree.files(root))], capture_output=True, text=True, cwd=root)
    problems = sorted(set(re.findall(r"^(.*?:\d+):\d+: error:", run.stderr, re.MULTILINE)))
    if run.returncode != 0 and not problems:
        problems = [run.stderr.strip() or f"clang-format ended with {run.returncode}"]
    return [f"{p}: not as clang-format leaves it (make format)" for p in problems]
