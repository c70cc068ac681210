"""Every name of include/cairn has one in Python, and the other way round."""

import re
import sys
from pathlib import Path
from typing import Iterator

import cairn
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "project"))
from checks.doc_blocks import declarations  # type: ignore[import]  # noqa: E402

# What has no name of its own in Python, and why.
WITHOUT: dict[str, str] = {
    **dict.fromkeys(("Vec3", "Mat3", "Quat"), "arrays of numpy"),
    **dict.fromkeys(("BodyView", "BodyViews"), "Bodies: its arrays hold the memory"),
    "ContactInfo": "contact_dtype: rows of World.contacts()",
    "Event": "event_dtype: rows of World.events()",
    "QueryFilter": "excluding= and groups= of the questions: except is a word of the language",
    "HullData": "for the engine itself",
    "BoundsTree": "for the engine itself",
    "Compound.tree": "for the engine itself",
    "SurfaceData": "for the engine itself",
    "MotionCurve": "for the engine itself",
    "Mesh.data": "for the engine itself",
    "HeightField.data": "for the engine itself",
    "TriangleCorners": "rows of arrays of numpy",
    "ConvexHull.data": "for the engine itself",
    "WorldState": "for the engine itself",
    "RollbackData": "for the engine itself",
    "DiagnosticsField.Fold": "Fold",
    "stage_count": "len(stage_names)",
    "presetNamed": "Preset['accuracy']; names are taken wherever members are",
    "nameOf": "Preset.accuracy.name",
    "setField": "Settings.replace()",
    "setFieldFromText": "SettingOverrides.fields",
    "SettingField.set": "Settings.replace()",
    "Statistics.add": "Statistics + Statistics",
    "StepRate": "Settings.steps_per_second and Settings.steps_by_size",
    "World.saveTo": "World.save(): bytes cannot be written again",
    "World.posesTo": "Bodies.poses()",
    "World.contactsTo": "World.contacts()",
    "World.bodyViews": "World.bodies",
    "World.contains": "id in world",
    **dict.fromkeys(("Ranks", "Traffic", "RankLostError", "RankLateError", "MessageDelay", "Partition", "PartitionKind"), "ranks are for programs in C++"),
    **dict.fromkeys(("runRanks", "mpiRanks", "isStartedByMpi", "partitionNamed", "sumOverRanks"), "likewise"),
    **dict.fromkeys(("World.share", "World.gather", "World.isDivided", "World.sums", "World.meanOverlap", "WorldSums", "World.ranks"), "likewise"),
    **dict.fromkeys(("SavedPart", "World.savePart", "World.restoreParts", "ReadPart", "World.saveCommon", "SceneRun.saveCommon", "SceneRun.restoreParts"), "likewise"),
    **dict.fromkeys(("World.isOwn", "FramePart", "captureFramePart", "RecordingPartWriter", "recordingPart"), "likewise"),
    **dict.fromkeys(("RecordingReader.framePart", "RecordingOptions.parts", "RecordingOptions.mark", "RecordingInfo.parts"), "likewise"),
    **dict.fromkeys(("SceneSource", "SceneSurvey", "readSceneSource", "builtInSource", "SceneRun.source"), "Scene: Python has all of it"),
    "mergeRecording": "cairn merge",
}

# What Python has besides: whole runs, arrays of all frames, and what C++ says in another way.
BESIDES: dict[str, str] = {
    **dict.fromkeys(("Recording", "Series", "Result", "run", "Table", "sweep"), "whole runs"),
    "Bodies": "BodyViews",
    **dict.fromkeys(("MaterialId.index", "GroupId.index"), "a cast to a number"),
    "Settings.steps_by_size": "StepRate",
    "body_id_dtype": "BodyId in arrays",
    "contact_dtype": "ContactInfo in arrays",
    "event_dtype": "Event in arrays",
    "SceneRun.hashed_simulation_step": "SceneRun::simulationStep(hashes)",
}


def snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])([A-Z])", lambda m: "_" + m[1].lower(), name)


def names_of(head: str) -> Iterator[str]:
    """The names that a declaration declares."""
    head = re.sub(r"\b(?:static|inline|constexpr|const|explicit|noexcept|friend|virtual)\b", " ", head)
    using = re.match(r"\s*using (\w+) =", head)
    if using:
        yield using[1]
        return
    enum = re.match(r"\s*enum (?:class )?(\w+)", head)
    kind = re.match(r"\s*(?:template\s*<.*?>\s*)?(?:struct|class) (\w+)", head)
    if enum or kind:
        yield (enum or kind)[1]  # type: ignore[index]
        return
    pointer = re.search(r"\(\*(\w+)\)", head)
    function = re.search(r"(\w+)\s*\(", head)
    if pointer or (function and "=" not in head[:function.start()]):
        yield (pointer or function)[1]  # type: ignore[index]
        return
    for part in re.sub(r"<[^<>]*(?:<[^<>]*>[^<>]*)*>", " ", head.split("=")[0].split("{")[0]).split(","):
        words = re.findall(r"\w+", re.sub(r"\[.*?\]", "", part))
        if words:
            yield words[-1]


def public_names() -> Iterator[str]:
    """All of them: "World.addBody" for members."""
    for header in sorted((ROOT / "include" / "cairn").glob("*.h")):
        for declaration in declarations(header.read_text(encoding="utf-8")):
            owner = ""
            if declaration.scope.kind == "type":
                owner = next(names_of(declaration.scope.head)) + "."
            if re.search(r"\boperator\b|~|=\s*delete|^friend\b|^using [\w:]+::", declaration.head):
                continue
            for name in names_of(declaration.head):
                if name + "." != owner:
                    yield owner + name


def enumerators() -> Iterator[tuple[str, list[str]]]:
    for header in sorted((ROOT / "include" / "cairn").glob("*.h")):
        text = re.sub(r"//.*", "", header.read_text(encoding="utf-8"))
        for name, body in re.findall(r"enum class (\w+)[^{};]*\{([^}]*)\}", text):
            members = [member.split("=")[0].strip() for member in body.split(",") if member.strip()]
            if members and name not in WITHOUT:
                yield name, members


NAMES = sorted(set(public_names()))


def has(name: str) -> bool:
    owner, _, member = name.rpartition(".")
    if not owner:
        return hasattr(cairn, name) or hasattr(cairn, snake(name))
    there = getattr(cairn, owner)
    if hasattr(there, snake(member)):
        return True
    # A setter is the other half of a property.
    setter = re.match(r"set_(\w+)", snake(member))
    return bool(setter and getattr(getattr(there, setter[1], None), "fset", None))


def test_the_headers_are_read() -> None:
    assert {"World", "World.addBody", "BodyDescription.linear_velocity", "readScene", "version"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_public_name_of_cpp_has_one_in_python(name: str) -> None:
    owner = name.split(".")[0]
    if name in WITHOUT or owner in WITHOUT:
        assert owner in WITHOUT or not has(name), f"{name} has a name by now: take it out of WITHOUT"
        return
    assert has(name), f"{name} has no name in Python: bind it, or say in WITHOUT why it cannot have one"


@pytest.mark.parametrize("enum, members", list(enumerators()))
def test_enumerations_have_the_same_members(enum: str, members: list[str]) -> None:
    assert [member.name for member in getattr(cairn, enum)] == members


def test_a_name_of_python_has_one_in_cpp() -> None:
    known = {snake(name.rpartition(".")[2]) for name in NAMES} | set(NAMES) | {"Fold"}
    unknown = [name for name in cairn.__all__ if name not in known and name not in BESIDES]
    for owner in cairn.__all__:
        there = getattr(cairn, owner)
        if not isinstance(there, type) or owner in BESIDES or issubclass(there, int):
            continue
        for member in vars(there):
            if member.startswith("_") or member == "replace" or f"{owner}.{member}" in BESIDES:
                continue
            both = {name.rpartition(".")[2] for name in NAMES if name.startswith(owner + ".")}
            if member not in {snake(name) for name in both} | {snake(n)[4:] for n in both if n.startswith("set")}:
                unknown.append(f"{owner}.{member}")
    assert unknown == [], "say in BESIDES what they are"


def test_what_has_no_name_is_still_there() -> None:
    types = set(NAMES) | {name.split(".")[0] for name in NAMES}
    forward = {"HullData", "BoundsTree", "SurfaceData", "WorldState", "RollbackData", "SceneSurvey"}
    assert [name for name in WITHOUT if name not in types | forward] == []
