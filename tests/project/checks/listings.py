"""README.md quotes examples/hello.cpp word for word, and it is a short program."""

import re
from pathlib import Path

LONGEST = 25


def check(root: Path) -> list[str]:
    hello = (root / "examples" / "hello.cpp").read_text(encoding="utf-8")
    readme = (root / "README.md").read_text(encoding="utf-8")
    problems = []
    if hello.count("\n") > LONGEST:
        problems.append(f"examples/hello.cpp: {hello.count(chr(10))} lines, at most {LONGEST}")
    if hello not in re.findall(r"^```cpp\n(.*?)^```$", readme, re.DOTALL | re.MULTILINE):
        problems.append("README.md: no cpp block is examples/hello.cpp word for word")
    return problems
