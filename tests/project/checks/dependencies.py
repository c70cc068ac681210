"""Every package of tools/packages.txt has one line of justification in docs/dependencies.md, and the other way round."""

import re
from pathlib import Path

from . import tree


def check(root: Path) -> list[str]:
    listed = {line.split()[1] for line in tree.lines(root / "tools" / "packages.txt")
              if line.strip() and not line.startswith("#")}
    rows = re.findall(r"^\|\s*`([^`]+)`\s*\|(.*)\|\s*$", (root / "docs" / "dependencies.md").read_text(encoding="utf-8"),
                      re.MULTILINE)
    justified = {name for name, reason in rows if reason.strip(" |")}
    return ([f"docs/dependencies.md: no line for {name}" for name in sorted(listed - justified)]
            + [f"tools/packages.txt: does not list {name} of docs/dependencies.md" for name in sorted(justified - listed)])
