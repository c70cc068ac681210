"""OpenMP stands in src/parallel only."""

import re
from pathlib import Path

from . import tree

_OPENMP = re.compile(r"#\s*pragma\s+omp|_Pragma|#\s*include\s*<omp\.h>|\bomp_\w+\s*\(")


def check(root: Path) -> list[str]:
    home = root / "src" / "parallel"
    return [f"{path.relative_to(root)}:{number}: OpenMP belongs into src/parallel"
            for path in tree.files(root, ("include", "src", "apps"))
            if home not in path.parents
            for number, line in enumerate(tree.without_comments(path.read_text(encoding="utf-8")).splitlines(), 1)
            if _OPENMP.search(line)]
