"""Every package of tools/packages.txt and every npm package of web/package.json has one line of justification in
docs/dependencies.md, and the other way round."""

import json
import re
from pathlib import Path

from . import tree


def _debian(root: Path, text: str) -> list[str]:
    listed = {line.split()[1] for line in tree.lines(root / "tools" / "packages.txt")
              if line.strip() and not line.startswith("#")}
    justified = {name for name, reason in re.findall(r"^\|\s*`([^`]+)`\s*\|(.*)\|\s*$", text, re.MULTILINE)
                 if reason.strip(" |")}
    return ([f"docs/dependencies.md: no line for {name}" for name in sorted(listed - justified)]
            + [f"tools/packages.txt: does not list {name} of docs/dependencies.md" for name in sorted(justified - listed)])


def _npm(root: Path, text: str) -> list[str]:
    page = root / "web" / "package.json"
    package = json.loads(page.read_text(encoding="utf-8")) if page.is_file() else {}
    listed = {*package.get("dependencies", {}), *package.get("devDependencies", {})}
    justified = set(re.findall(r"^- `([^`]+)`: \w", text, re.MULTILINE))
    return ([f"docs/dependencies.md: no line for the npm package {name}" for name in sorted(listed - justified)]
            + [f"web/package.json: does not list {name} of docs/dependencies.md" for name in sorted(justified - listed)])


def check(root: Path) -> list[str]:
    text = (root / "docs" / "dependencies.md").read_text(encoding="utf-8")
    return _debian(root, text) + _npm(root, text)
