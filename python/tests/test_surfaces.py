"""Meshes and height fields from arrays and files."""

import pickle
from pathlib import Path

import cairn
import numpy as np
import pytest

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]


def test_a_mesh_shows_its_arrays() -> None:
    mesh = cairn.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3], [0, 2, 3]], sides="two", scale=[2, 1, 1])
    assert mesh.vertices.shape == (4, 3) and mesh.vertices[1, 0] == 2
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.sides is cairn.SurfaceSides.two
    assert mesh.repairs.duplicate == 1 and mesh.bytes > 100
    with pytest.raises(ValueError):
        mesh.vertices[0, 0] = 1
    again = pickle.loads(pickle.dumps(mesh))
    assert np.array_equal(again.vertices, mesh.vertices) and again.sides == mesh.sides


def test_a_height_field_has_rows_along_y() -> None:
    field = cairn.HeightField([[0, 1, 2], [3, 4, 5]], [0.5, 2])
    assert (field.rows, field.columns) == (2, 3)
    assert field.heights.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert field.vertices[5].tolist() == [0.5, 1, 5]
    assert field == pickle.loads(pickle.dumps(field))


def test_bad_input_is_refused() -> None:
    with pytest.raises(cairn.InputError, match="the vertex"):
        cairn.Mesh(SQUARE, [[0, 1, -1]])
    with pytest.raises(cairn.InputError, match="finite"):
        cairn.Mesh(np.array([[0, 0, np.nan], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]])
    with pytest.raises(TypeError):
        cairn.Mesh(SQUARE, [0, 1, 2])
    with pytest.raises(TypeError, match="whole numbers"):
        cairn.Mesh(SQUARE, [[0, 1, 2.5]])
    with pytest.raises(cairn.InputError, match="the vertex -1; indices count from 0"):
        cairn.Mesh(SQUARE, [[0, 1, -1]])
    with pytest.raises(cairn.InputError, match="two rows"):
        cairn.HeightField([[1, 2]], [1, 1])


def test_files(tmp_path: Path) -> None:
    file = tmp_path / "square.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    mesh = cairn.read_mesh(file)
    assert len(mesh.triangles) == 2
    assert mesh == cairn.parse_mesh(file.read_bytes(), "square")
    with pytest.raises(cairn.IoError):
        cairn.read_mesh(tmp_path / "none.stl")
    with pytest.raises(cairn.InputError, match="PNG"):
        cairn.parse_height_field(b"nothing", "x", [1, 1], 1)


def test_a_ball_rests_on_a_mesh() -> None:
    world = cairn.World()
    world.gravity = [0, 0, -10]
    oak = world.add_material(name="oak", density=800)
    ground = cairn.Mesh(np.array(SQUARE) * 4 - [2, 2, 0], [[0, 1, 2], [0, 2, 3]])
    world.add_body(shape=ground, material=oak, fixed=True)
    ball = world.add_body(shape=cairn.Sphere(0.1), material=oak, pose=cairn.Pose([0.1, 0.1, 0.3]))
    for _ in range(480):
        world.step()
    assert world.pose(ball).position[2] == pytest.approx(0.1, abs=2e-3)
    hit = world.cast_ray(cairn.Ray([0.5, 0.3, 1], [0, 0, -1]))
    assert hit is not None and hit.distance == pytest.approx(1) and hit.part == 0


def test_a_concave_solid_in_convex_parts() -> None:
    # A prism over an angle of two legs, each 2 m long and 1 m thick.
    outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    top = [[6, 7, 8], [6, 8, 9], [6, 9, 11], [9, 10, 11]]
    bottom = [[c - 6, b - 6, a - 6] for a, b, c in top]
    sides = [t for i in range(6) for t in ([i, (i + 1) % 6, (i + 1) % 6 + 6], [i, (i + 1) % 6 + 6, i + 6])]
    mesh = cairn.Mesh(vertices, top + bottom + sides)
    found = cairn.decompose(mesh)
    assert len(found.compound.parts) == 2 and abs(found.error) < 1e-12 and not found.turned
    assert found.compound.solid is not None
    assert found.compound.solid.volume == pytest.approx(3)
    assert np.allclose(found.compound.solid.centre, [5 / 6, 5 / 6, 0.5])
    coarse = cairn.decompose(mesh, cairn.DecompositionOptions(most_parts=1))
    assert coarse.error == pytest.approx(0.5 / 3)
    assert cairn.volume_error_of(coarse.compound) == pytest.approx(0.5 / 3)
    with pytest.raises(cairn.InputError, match="3 open edges around 1 hole"):
        cairn.decompose(cairn.Mesh(vertices, (top + bottom + sides)[1:]))
    world = cairn.World()
    oak = world.add_material(name="oak", density=800)
    assert world.mass(world.add_body(shape=coarse.compound, material=oak)) == pytest.approx(2400)
