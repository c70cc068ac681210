"""The report of a quick run has every entry, figure and check: check_report.py FOLDER"""

import json
import sys
from pathlib import Path

E6400 = ("stacks5", "well324", "cage384")
I7 = ("stacks8", "well392", "cage2816")

ENTRIES = (
    [f"5.1/{scene}/{what}" for scene in E6400 + I7 for what in ("total", "average")]
    + [f"5.2/{scene}/{what}" for scene in ("stacks5", "cage384", "stacks8")
       for what in ("time_saved", "best_step", "best_response", "largest_batch")]
    + [f"5.3/{scene}/{what}" for scene in E6400 for what in ("speedup", "best_step", "asleep", "asleep_undamped")]
    + ["5.3/mean/speedup"]
    + [f"5.4/{scene}/{what}" for scene in E6400[:2]
       for what in ("fewer_iterations", "speedup", "most_iterations", "best_step_iterations", "best_step_time")]
    + [f"5.5/{scene}/{what}" for scene in E6400 for what in ("speedup", "average", "best_step")]
    + [f"5.6/catapult{boxes}/{what}" for boxes in (7, 15) for what in ("peak", "range")]
    + [f"5.6/cradle/{balls}/{moving}" for balls in (5, 7) for moving in range(1, balls)]
    + ["5.6/cradle/drift", "5.6/spin/horizontal", "5.6/spin/vertical"]
)
# What may never happen within a run has no value: bodies that do not fall asleep, a ball that spins on.
MAY_LACK = [f"5.3/{scene}/asleep_undamped" for scene in E6400] + ["5.6/spin/vertical"]
# A quick run ends these scenes early: no number of theirs may be compared with the thesis's, which is of the whole one.
SHORTENED = (
    [f"5.1/{scene}/" for scene in I7] + ["5.2/stacks8/"] + [f"5.4/{scene}/" for scene in E6400[:2]]
    + [f"5.5/{scene}/" for scene in E6400]
)
FIGURES = {"5.1": 6, "5.2": 6, "5.3": 6, "5.4": 4, "5.5": 3, "5.6": 4}
PICTURE_ROWS = {"5.1": 6, "5.5": 6, "5.6": 2}


def compared_wrongly(entries: dict) -> list[str]:
    """Entries of a part of a scene that have a factor to the thesis, and others that are said to be of a part."""
    found = []
    for name, entry in entries.items():
        shortened = name.startswith(tuple(SHORTENED))
        if entry["shortened"] != shortened:
            found.append(f"{name} is {'not ' * shortened}said to be shortened")
        if shortened and (entry["difference_percent"] is not None or "explanation" in entry):
            found.append(f"{name} compares a part of a scene with the thesis's whole one")
        if not shortened and entry["thesis"] and entry["ours"] is not None and entry["difference_percent"] is None:
            found.append(f"{name} is not compared with the thesis")
    return found


def problems(report: dict) -> list[str]:
    found = []
    sections = {section["id"]: section for section in report["sections"]}
    entries = {entry["id"]: entry for section in report["sections"] for entry in section["entries"]}
    found += [f"no entry {name}" for name in ENTRIES if name not in entries]
    found += [f"unexpected entry {name}" for name in entries if name not in ENTRIES]
    found += [f"{name} has no value" for name, entry in entries.items() if entry["ours"] is None and name not in MAY_LACK]
    found += compared_wrongly(entries)
    for section, count in FIGURES.items():
        figures = sections[section]["figures"]
        if len(figures) != count:
            found.append(f"§{section} has {len(figures)} figures instead of {count}")
        for figure in figures:
            if not all(any(y is not None for y in line["y"]) for line in figure["lines"]):
                found.append(f"figure {figure['id']} has an empty line")
    found += [f"§{section} has not {count} rows of pictures" for section, count in PICTURE_ROWS.items()
              if len(sections[section]["pictures"]) != count]
    checks = [check for section in report["sections"] for check in section["checks"]]
    found += [f"does not hold: {check['what']}" for check in checks if not check["holds"]]
    if len(checks) < 25:
        found.append(f"there are {len(checks)} checks only")
    return found


def main() -> int:
    folder = Path(sys.argv[1])
    report = json.loads((folder / "results.json").read_text(encoding="utf-8"))["report"]
    found = problems(report)
    page = folder / "index.html"
    if page.exists() and "/* report */" in page.read_text(encoding="utf-8"):
        found.append("the page has no report in it")
    for problem in found:
        print(problem)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
