"""Records: values that are made, shown, compared, copied and pickled."""

import copy
import pickle

import cairn
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

LENGTHS = st.floats(1e-3, 1e3)
VECTORS = st.tuples(*[st.floats(-1e6, 1e6)] * 3)
SHAPES = st.one_of(
    st.builds(cairn.Sphere, LENGTHS),
    st.builds(cairn.Box, st.tuples(LENGTHS, LENGTHS, LENGTHS)),
    st.builds(cairn.Capsule, LENGTHS, LENGTHS),
    st.builds(cairn.Cylinder, radius=LENGTHS, length=LENGTHS),
    st.builds(cairn.HalfSpace, VECTORS, offset=LENGTHS),
)


@settings(max_examples=50, deadline=None, derandomize=True)
@given(SHAPES, VECTORS, st.booleans(), st.one_of(st.none(), LENGTHS))
def test_records_go_round(shape: cairn.Sphere, vector: tuple[float, float, float], fixed: bool, mass: float) -> None:
    body = cairn.SceneBody(shape, "oak", position=vector, fixed=fixed, mass=mass)
    assert pickle.loads(pickle.dumps(body)) == body == copy.deepcopy(body)
    assert body.shape == shape and tuple(body.position) == vector and body.mass == mass
    assert body.replace(name="other") != body
    assert body.replace(name="other").replace(name="") == body


def test_records_are_frozen_and_shown_as_written() -> None:
    sphere = cairn.Sphere(radius=0.25)
    assert repr(sphere) == "Sphere(radius=0.25)"
    assert eval(repr(cairn.Pose([1, 2, 3])), {"Pose": cairn.Pose}) == cairn.Pose(position=(1, 2, 3))
    with pytest.raises(AttributeError):
        sphere.radius = 1  # type: ignore[misc]
    with pytest.raises(ValueError):
        cairn.Pose().position[0] = 1
    with pytest.raises(TypeError, match="needs the field 'density'"):
        cairn.Material("oak")  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="twice"):
        cairn.Sphere(1, radius=2)  # type: ignore[misc]
    with pytest.raises(TypeError, match="at most"):
        cairn.Sphere(1, 2)  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        hash(sphere)
    assert sphere != 0.25


def test_every_record_can_be_made_of_what_it_says() -> None:
    for name in cairn.__all__:
        record = getattr(cairn, name)
        others = ("JointInfo", "Result", "CompoundPart", "Compound", "ConvexHull", "ShapeContact",
                  "Decomposition", "SolidProperties", "HeightField", "Mesh")
        if not hasattr(record, "__match_args__") or name in others:
            continue
        values = {"name": "a", "shape": cairn.Sphere(), "material": "oak", "duration": 1, "density": 1, "a": 0, "b": 0,
                  "joint": cairn.JointDescription(), "gravity": [0, 0, 0], "body": 0, "velocity": [0, 0, 0],
                  "impulse": [0, 0, 0], "force": [0, 0, 0], "torque": [0, 0, 0], "time": 0,
                  "action": cairn.SetGravity([0, 0, 0]), "times": [0, 1], "what": "position",
                      "target": 0}
        try:
            made = record()
        except TypeError:
            needed = {field: values[field] for field in record.__match_args__ if field in values}
            if name == "SpringDescription":
                needed = {"a": cairn.BodyId(0, 0)}
            made = record(**needed)
        assert record(*(getattr(made, field) for field in record.__match_args__)) == made, name


def test_hulls_and_compounds() -> None:
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    hull = cairn.ConvexHull(np.vstack([corners, [[0.5, 0.5, 0.5]]]))
    assert hull.points.shape == (9, 3) and hull.corners.shape == (8, 3)
    assert pickle.loads(pickle.dumps(hull)) == hull
    with pytest.raises(cairn.InputError):
        cairn.ConvexHull([[0, 0, 0]])
    part = cairn.CompoundPart(hull, pose=cairn.Pose([0, 0, 1]), mass=2)
    compound = cairn.Compound([part, cairn.CompoundPart(cairn.Sphere(0.1))])
    assert compound.parts[0] == part and len(compound.parts) == 2
    assert pickle.loads(pickle.dumps(compound)) == compound


def test_ids_are_names() -> None:
    ids = [cairn.BodyId(1, 2), cairn.BodyId(0, 5), cairn.BodyId(1, 0)]
    assert sorted(ids) == [cairn.BodyId(0, 5), cairn.BodyId(1, 0), cairn.BodyId(1, 2)]
    assert len({*ids, cairn.BodyId(1, 2)}) == 3
    assert cairn.BodyId(1, 2) != cairn.JointId(1, 2)
    assert pickle.loads(pickle.dumps(cairn.MaterialId(3))) == cairn.MaterialId(3)


def test_poses_map_points() -> None:
    quarter = np.sqrt(0.5)
    pose = cairn.Pose([1, 0, 0], [quarter, 0, 0, quarter])
    assert pose.to_outer([1, 0, 0]) == pytest.approx([1, 1, 0])
    assert pose.to_inner([1, 1, 0]) == pytest.approx([1, 0, 0])
    assert pose.to_outer(pose.inverse()).position == pytest.approx([0, 0, 0])


def test_enumerations_are_pythons() -> None:
    assert cairn.JointKind(3) is cairn.JointKind.hinge
    assert cairn.JointKind["hinge"] is cairn.JointDescription("hinge").kind
    assert pickle.loads(pickle.dumps(cairn.Preset.accuracy)) is cairn.Preset.accuracy
    with pytest.raises(cairn.InputError, match="choose one of distance, rope"):
        cairn.JointDescription("glue")
    with pytest.raises(TypeError):
        cairn.JointDescription(3)  # type: ignore[arg-type]


def test_statistics_add_up() -> None:
    one = cairn.Statistics(contacts=2, largest_overlap=0.5)
    both = one + cairn.Statistics(contacts=3, largest_overlap=0.25)
    assert both.contacts == 5 and both.largest_overlap == 0.5 and one.contacts == 2
    fields = {field.name: field for field in cairn.diagnostics_fields()}
    assert fields["energy"].of(cairn.Diagnostics(energy=3)) == 3
    assert fields["energy"].fold is cairn.Fold.newest
    assert len(one.stage_ms) == len(cairn.stage_names) == len(cairn.Stage)
