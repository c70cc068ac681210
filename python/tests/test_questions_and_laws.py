"""Questions about shapes and bodies, groups and sensors, and motion by a law."""

import pickle

import cairn
import numpy as np
import pytest
from tools import ground, tower


def test_rays_meet_bodies() -> None:
    world = tower(3)
    boxes = list(world.bodies)[1:]
    down = cairn.Ray([0, 0, 2], [0, 0, -3])
    hit = world.cast_ray(down)
    assert hit is not None and hit.body == boxes[2] and isinstance(hit, cairn.SurfaceHit)
    assert hit.distance == pytest.approx(1.4) and hit.normal == pytest.approx([0, 0, 1])
    assert hit.point == pytest.approx([0, 0, 0.6])
    assert pickle.loads(pickle.dumps(hit)) == hit != hit.replace(body=boxes[0])
    assert [through.body for through in world.cast_ray_through(down)] == [*boxes[::-1], list(world.bodies)[0]]
    below = world.cast_ray(down, excluding=boxes[1:])
    assert below is not None and below.body == boxes[0]
    hits = world.cast_rays([down, cairn.Ray([0, 0, 2], [0, 0, 1]), down.replace(reach=1)])
    assert hits == [hit, None, None]
    alone = cairn.cast_ray(cairn.Sphere(0.5), cairn.Pose([0, 0, 1]), down)
    assert alone is not None and alone.distance == pytest.approx(0.5)
    with pytest.raises(cairn.InputError):
        world.cast_ray(cairn.Ray(direction=[0, 0, 0]))
    with pytest.raises(TypeError):
        world.cast_ray(down, boxes)  # type: ignore[misc]


def test_shapes_meet_overlap_and_come_close() -> None:
    world = tower(2)
    low, high = list(world.bodies)[1:]
    ball = cairn.Sphere(0.1)
    hit = world.cast_shape(ball, cairn.Pose([0, 0, 1]), [0, 0, -2])
    assert hit is not None and hit.body == high and hit.distance == pytest.approx(0.5, abs=1e-6)
    assert isinstance(hit, cairn.ShapeHit)
    assert world.cast_shape(ball, cairn.Pose([0, 0, 1]), [0, 0, -0.4]) is None
    assert world.overlap(ball, cairn.Pose([0.15, 0, 0.3])) == [cairn.Overlap(high, 0)]
    assert world.overlap([-1, -1, 0.01], [1, 1, 0.19]) == [cairn.Overlap(low, 0)]
    near = world.closest_points(ball, cairn.Pose([0.5, 0, 0.3]), 0.4)
    assert [body.body for body in near] == [list(world.bodies)[0], high, low]
    assert near[1].closest.distance == pytest.approx(0.3)
    assert near[1].closest.on_a == pytest.approx([0.4, 0, 0.3])
    assert world.closest_points(low, high).distance == pytest.approx(0, abs=1e-9)
    where = cairn.Pose(), cairn.Pose([0.15, 0, 0])
    assert cairn.overlap(ball, where[0], ball, where[1])
    assert cairn.closest_points(ball, where[0], ball, where[1]).distance == pytest.approx(-0.05)
    contacts = cairn.contacts_of(ball, where[0], ball, where[1], 0)
    assert len(contacts) == 1 and contacts[0].point == pytest.approx([0.075, 0, 0])
    touched = cairn.cast_shape(ball, cairn.Pose([1, 0, 0]), [-1, 0, 0], ball, cairn.Pose())
    assert touched is not None and touched.distance == pytest.approx(0.8, abs=1e-6)


def test_groups_and_exceptions_let_bodies_through() -> None:
    world, oak = ground()
    ghosts, ground_group = world.add_group("ghosts"), world.add_group("ground")
    world.set_groups_touch(ghosts, ground_group, "never")
    floor = next(iter(world.bodies))
    world.set_groups(floor, [ground_group])
    ghost = world.add_body(cairn.Sphere(0.1), oak, position=[0, 0, 0.1], groups=[ghosts])
    excepted = world.add_body(cairn.Sphere(0.1), oak, position=[1, 0, 0.1], groups=[ghosts])
    world.set_pair_touch(floor, excepted, cairn.Touch.always)
    assert world.group_names == ("ghosts", "ground") and world.groups(ghost) == [ghosts]
    assert world.groups_touch(ground_group, ghosts) is cairn.Touch.never
    assert world.pair_touch(excepted, floor) is cairn.Touch.always and world.pair_touch(floor, ghost) is None
    hits = world.cast_ray_through(cairn.Ray([0, 0, 1], [0, 0, -1]), groups=[ghosts])
    assert [hit.body for hit in hits] == [ghost]
    world.step(120)
    assert world.pose(ghost).position[2] < -0.5 < world.pose(excepted).position[2]
    assert pickle.loads(pickle.dumps(ghosts)) == ghosts != ground_group and len({ghosts, ground_group}) == 2
    with pytest.raises(cairn.InputError):
        world.set_groups(ghost, [cairn.GroupId(9)])
    with pytest.raises(cairn.InputError, match="group 9 is unknown"):
        world.cast_ray(cairn.Ray([0, 0, 1], [0, 0, -1]), groups=[cairn.GroupId(9)])
    for i in range(2, cairn.most_groups):
        world.add_group(str(i))
    with pytest.raises(cairn.InputError):
        world.add_group("one too many")


def test_sensors_tell_who_is_inside() -> None:
    world, oak = ground()
    gate = world.add_body(cairn.Box([1, 1, 0.2]), oak, position=[0, 0, 1], fixed=True, sensor=True)
    ball = world.add_body(cairn.Sphere(0.05), oak, position=[0, 0, 1.3])
    world.event_level = "changes"
    kinds = []
    while world.pose(ball).position[2] > 0.5:
        world.step()
        kinds += [event["kind"] for event in world.events() if event["a"]["index"] == gate.index]
        if world.sensed():
            assert world.sensed() == [cairn.Sensed(gate, ball)]
    assert kinds == [cairn.EventKind.sensor_entered, cairn.EventKind.sensor_left]
    assert world.is_sensor(gate) and not world.is_sensor(ball)


def test_bodies_have_properties_of_their_own() -> None:
    world, oak = ground()
    body = world.add_body(cairn.Sphere(0.1), oak, position=[0, 0, 1], gravity_factor=0, user_data=2**64 - 1,
                          linear_velocity=[1, 0, 0])
    assert world.gravity_factor(body) == 0 and world.user_data(body) == 2**64 - 1
    world.set_damping(body, linear=2, angular=3)
    assert (world.linear_damping(body), world.angular_damping(body)) == (2, 3)
    world.step(240)
    assert world.pose(body).position[2] == 1 and world.linear_velocity(body)[0] == pytest.approx(np.exp(-2), rel=0.02)
    world.set_gravity_factor(body, 0.5)
    world.set_user_data(body, 7)
    assert world.gravity_factor(body) == 0.5 and world.user_data(body) == 7


def test_bodies_and_the_frame_move_by_laws() -> None:
    world, oak = ground()
    law = cairn.SineMotion(amplitude=[0.1, 0, 0], frequency=2, phase=np.pi / 2)
    table = world.add_body(cairn.Box([1, 1, 0.1]), oak, position=[0, 0, 1], fixed=True, motion=law)
    belt = world.add_body(cairn.Box([4, 1, 0.1]), oak, position=[0, 3, 0.05], fixed=True, surface_velocity=[1, 0, 0])
    load = world.add_body(cairn.Box([0.2, 0.2, 0.2]), oak, position=[-1, 3, 0.2])
    assert world.motion(table) == law and world.motion(belt) is None
    assert world.surface_velocity(belt) == pytest.approx([1, 0, 0])
    world.step(60)
    assert world.pose(table).position == pytest.approx([-0.2, 0, 1], abs=1e-6)
    world.stop_motion(table)
    places = [[0, 0, 0], [0, 0, 1]]
    world.set_motion(table, cairn.TableMotion([0, 1], displacements=places, end="hold"), pivot=[0, 0, 0])
    moved = world.motion(table)
    assert isinstance(moved, cairn.TableMotion) and moved.displacements.tolist() == places and len(moved.turns) == 0
    before = world.pose(table).position[2]
    world.step(300)
    assert world.pose(table).position[2] == pytest.approx(before + 1)
    assert world.linear_velocity(load)[0] == pytest.approx(1, abs=0.02)
    with pytest.raises(cairn.InputError):
        world.set_motion(load, cairn.ConstantMotion(spin=[0, 0, 1]))
    accelerations = [[np.sin(0.1 * i), 0, 0] for i in range(100)]
    shaken = cairn.integrate_accelerogram(0.01, accelerations, "at_rest")
    assert pickle.loads(pickle.dumps(shaken)) == shaken and shaken.displacements.shape == (len(shaken.times), 3)
    world.frame_motion = shaken
    assert world.frame_motion == shaken
    world.frame_motion = None
    assert world.frame_motion is None
    rising = cairn.TableMotion([0, 1], [[0, 0, 0], [0, 0, 5]])
    world.set_gravity([0, 0, -10], rising)
    assert world.gravity_law == rising
    world.step(300)
    assert world.gravity.tolist() == [0, 0, -5]
    world.gravity = [0, 0, -10]
    assert world.gravity_law is None


def test_scenes_hold_filters_and_motions() -> None:
    scene = cairn.Scene(
        "filters",
        duration=1,
        materials=[cairn.Material("oak", 800)],
        filters=cairn.SceneFilters(["a", "b"], apart=[("a", "b")], exceptions=[cairn.SceneException(0, 1, "never")]),
        frame_motion=cairn.SineMotion(amplitude=[0.01, 0, 0]),
        gravity=[0, 0, -10],
        gravity_law=cairn.ConstantMotion(velocity=[1, 0, 0]),
        bodies=[
            cairn.SceneBody(cairn.Box(), "oak", fixed=True, motion=cairn.ConstantMotion([0, 0, 1]), pivot=[0, 0, 1]),
            cairn.SceneBody(cairn.Sphere(), "oak", position=[0, 0, 9], groups=["a"], gravity_factor=0.5, user_data=3),
        ],
    )
    assert not scene.filters.is_empty() and cairn.SceneFilters().is_empty()
    read = cairn.parse_scene(cairn.format_scene(scene))
    assert read.gravity_law == scene.gravity_law and cairn.SceneRun(read).world.gravity_law == scene.gravity_law
    assert read.filters == scene.filters and read.frame_motion == scene.frame_motion
    assert read.bodies[0].motion == scene.bodies[0].motion and read.bodies[1].groups == ("a",)
    run = cairn.SceneRun(read)
    assert run.world.group_names == ("a", "b") and run.world.user_data(run.ids[1]) == 3
