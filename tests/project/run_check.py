"""Runs one check of the source tree: run_check.py NAME ROOT. Prints the problems; exit code 1 if there are any."""

import importlib
import sys
from pathlib import Path


def main() -> int:
    name, root = sys.argv[1], Path(sys.argv[2]).resolve()
    check = importlib.import_module(f"checks.{name}")
    problems = check.check(root)
    for problem in problems:
        print(problem)
    print(f"{name}: {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
