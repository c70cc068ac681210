"""Calls for one body, errors, snapshots, threads and equality with C++."""

import gc
import pickle
import threading
from pathlib import Path
from typing import Callable

import cairn
import numpy as np
import pytest
from tools import exact, ground, tower


def test_a_box_falls_and_comes_to_rest() -> None:
    world, oak = ground(exact())
    box = world.add_body(cairn.Box([0.2, 0.2, 0.2]), oak, position=[0, 0, 1], name="box")
    assert world.body_count == len(world.bodies) == 2
    assert box in world and cairn.BodyId(7, 0) not in world and world.name(box) == "box"
    assert world.mass(box) == pytest.approx(800 * 0.2**3)
    world.step()
    assert world.linear_velocity(box)[2] == pytest.approx(-10 / 240)
    while not world.is_asleep(box):
        world.step(10)
    assert world.pose(box).position[2] == pytest.approx(0.1, abs=2e-3)
    assert world.step_count == round(world.time * 240)
    assert world.shape(box) == cairn.Box([0.2, 0.2, 0.2])
    assert world.materials == (cairn.Material("oak", 800),)


def test_what_was_given_wrongly_is_refused_by_exceptions_that_fit() -> None:
    world, oak = ground()
    body = world.add_body(cairn.Sphere(0.1), oak, position=[0, 0, 1])
    with pytest.raises(ValueError, match="density"):
        world.add_material("air", -1)
    with pytest.raises(cairn.InputError, match="finite"):
        world.set_linear_velocity(body, [0, np.nan, 0])
    with pytest.raises(TypeError):
        world.set_linear_velocity(body, [0, 1])
    with pytest.raises(TypeError, match="colour"):
        world.add_body(cairn.Sphere(), oak, colour="red")  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="Sphere.radius"):
        cairn.Sphere("large")  # type: ignore[arg-type]
    with pytest.raises(cairn.InputError, match="hinge"):
        world.add_joint("glue", body)
    world.remove_body(body)
    for error in (cairn.StaleIdError, LookupError, ValueError):
        with pytest.raises(error):
            world.pose(body)
    with pytest.raises(OSError):
        cairn.read_scene("/nowhere/scene.json")
    assert issubclass(cairn.InvariantError, RuntimeError)


def test_joints_springs_and_events() -> None:
    world, oak = ground()
    ball = world.add_body(cairn.Sphere(0.1), oak, position=[1, 0, 2])
    joint = world.add_joint(cairn.JointKind.rope, ball, anchor=[1, 0, 2], anchor_b=[0, 0, 2])
    assert joint in world and world.joints() == [joint]
    spring = world.add_spring(ball, anchor_b=[0, 0, 0], stiffness=1)
    world.event_level = "changes"
    for _ in range(60):
        world.step()
    info = world.joint(joint)
    assert info.kind is cairn.JointKind.rope and info.position == pytest.approx(1, abs=1e-3)
    world.remove_spring(spring)
    world.remove_joint(joint)
    kinds = set()
    while world.time < 3:
        world.step()
        events = world.events()
        kinds |= set(events["kind"].tolist())
    assert cairn.EventKind.contact_begun in kinds
    assert world.event_level is cairn.EventLevel.changes


def test_contacts_are_a_structured_array() -> None:
    world = tower(3, exact())
    world.step(5)
    contacts = world.contacts()
    assert contacts.dtype == cairn.contact_dtype
    assert len(contacts) == world.statistics.contacts > 0
    assert (contacts["a"]["index"] < contacts["b"]["index"]).all()
    assert contacts["normal"].shape == (len(contacts), 3)
    assert np.linalg.norm(contacts["normal"], axis=1) == pytest.approx(np.ones(len(contacts)))
    # The floor bears the weight of all in every step.
    on_floor = contacts[contacts["a"]["index"] == 0]
    assert -on_floor["impulse"][:, 2].sum() == pytest.approx(3 * 800 * 0.2**3 * 10 / 240, rel=0.05)
    with pytest.raises(ValueError):
        contacts["distance"][0] = 0
    assert contacts.tobytes() == world.contacts().tobytes()


def test_pickles_and_moments_are_snapshots() -> None:
    world = tower(4)
    world.step(7)
    copy = pickle.loads(pickle.dumps(world))
    moment = cairn.RollbackState()
    world.keep(moment)
    saved = world.save()
    world.step(30)
    copy.step(30)
    assert copy.state_hash() == world.state_hash()
    expected = world.state_hash()
    for state in (moment, saved, bytearray(saved)):
        world.load(state)  # type: ignore[arg-type]
        world.step(30)
        assert world.state_hash() == expected
    with pytest.raises(cairn.InputError):
        cairn.World.restore(saved[:-5])
    with pytest.raises(cairn.InputError):
        world.load(cairn.RollbackState())
    with pytest.raises(TypeError):
        pickle.dumps(moment)


def test_python_computes_what_cpp_computes(tmp_path: Path) -> None:
    recording = cairn.run("stacks5", duration=1000 / 240, record=tmp_path / "run.h5", hashes=True).recording
    # All of the second simulation runs in C++, which compares the state after each of the 1000 time steps.
    assert recording is not None and recording.info.hashes_per_frame * (len(recording) - 1) >= 1000
    assert recording.verify() is None


def test_threads_change_no_bit() -> None:
    scene = cairn.built_in_scene("stacks5")
    runs = [cairn.SceneRun(scene, cairn.settings_for(scene).replace(threads=threads)) for threads in (1, 2)]
    for run in runs:
        run.step(1000)
    assert runs[0].world.state_hash() == runs[1].world.state_hash()


def test_a_world_that_another_thread_steps_is_refused_and_the_interpreter_runs_on() -> None:
    world = tower(40)
    go_on = True

    def step() -> None:
        while go_on:
            world.step()

    thread = threading.Thread(target=step)
    thread.start()
    refused = turns = 0
    try:
        while refused < 3 and turns < 10**7:
            turns += 1
            try:
                world.bodies.linear_velocity
            except RuntimeError as error:
                refused += 1
                assert "another thread" in str(error)
    finally:
        go_on = False
        # The thread may have been refused, too, and ended with that.
        thread.join()
    assert refused == 3
    world.step()


def test_a_step_takes_a_number_by_place_or_by_name() -> None:
    world = tower(2)
    world.step()
    world.step(2)
    world.step(steps=3)
    step: Callable[..., None] = world.step
    step(np.int64(4))
    bound = world.step
    bound(steps=0)
    assert world.step_count == 10
    with pytest.raises(cairn.InputError, match="at least 0"):
        world.step(-1)
    calls: list[tuple[tuple[object, ...], dict[str, object]]] = [
        ((1, 2), {}), ((), {"often": 2}), ((1.5,), {}), ((2,), {"steps": 2}), (("2",), {})]
    for places, names in calls:
        with pytest.raises(TypeError):
            step(*places, **names)
    with pytest.raises(OverflowError):
        world.step(10**30)
    with pytest.raises(TypeError):
        cairn.World.step(world.bodies)  # type: ignore[arg-type]
    assert world.step_count == 10


def test_worlds_of_a_class_of_ones_own_step_and_unmade_ones_are_refused() -> None:
    class Mine(cairn.World):
        pass

    world = Mine()
    world.step()
    assert world.step_count == 1 and len(world.bodies.linear_velocity) == 0
    unmade = cairn.World.__new__(cairn.World)
    with pytest.raises(TypeError, match="__init__"):
        unmade.step()
    with pytest.raises(TypeError, match="__init__"):
        unmade.bodies


def test_parts_keep_what_they_belong_to() -> None:
    run = cairn.SceneRun(cairn.built_in_scene("tower:3"))
    world = run.world
    bodies = world.bodies
    velocity = bodies.linear_velocity
    del run, world
    gc.collect()
    assert len(bodies) == 4 and velocity.shape == (4, 3)


def test_settings_are_frozen_and_replaced() -> None:
    settings = cairn.Settings.preset("accuracy", gravity=9.81)
    assert settings.steps_per_second == 960
    changed = settings.replace(iterations=3, correction="none", threads=2)
    assert changed.resolution.iterations == 3 and changed.correction.correction is cairn.CorrectionKind.none
    assert settings.resolution.iterations != 3
    with pytest.raises(AttributeError):
        settings.resolution.iterations = 3  # type: ignore[misc]
    with pytest.raises(cairn.InputError, match="thread"):
        settings.replace(threads=0)
    with pytest.raises(cairn.InputError):
        settings.replace(speed="fast")
    with pytest.raises(cairn.InputError, match="arbitrary_order"):
        settings.replace(order="arbitrary")
    with pytest.raises(cairn.InputError, match="arbitrary_order"):
        cairn.ResolutionSettings(order="arbitrary")  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="no field 'damping'"):
        cairn.ResolutionSettings(damping=0.5)  # type: ignore[call-arg]
    world = cairn.World(changed)
    world.settings = world.settings.replace(threads=1)
    assert world.settings == changed.replace(threads=1)
    for field in cairn.setting_fields():
        value = cairn.get_field(settings, field.name)
        assert value == field.get(settings)
        assert cairn.get_field(settings.replace(**{field.name: value}), field.name) == value
    assert cairn.preset_names() == tuple(preset.name for preset in cairn.Preset)


def test_joints_have_axes_servos_and_couplings() -> None:
    world = cairn.World()
    steel = world.add_material("steel", 7800)
    wheels = [world.add_body(cairn.Sphere(0.1), steel, position=[x, 0, 0]) for x in (0, 1)]
    hinges = [world.add_joint("hinge", wheel, anchor=[x, 0, 0]) for x, wheel in enumerate(wheels)]
    gear = world.add_joint("gear", first=hinges[0], second=hinges[1], ratio=2)
    world.set_joint_servo(hinges[0], speed=1, damping=1e9)
    world.step(20)
    assert world.joint(hinges[1]).speed == pytest.approx(-2)
    assert world.joint(gear).kind is cairn.JointKind.gear
    axis = cairn.JointAxis("turn_y", spring=cairn.JointSpring(3), friction=1)
    assert axis.along is cairn.JointAlong.turn_y
    body = world.add_body(cairn.Sphere(0.1), steel, position=[3, 0, 0], locked=["x"])
    world.add_joint("generic", body, axes=[axis])
    assert world.locked(body) == (cairn.JointAlong.x,)
    world.set_pair_law(steel, steel, friction=cairn.SpeedCurve([0, 1], [0.5, 0.2]))
    assert world.pair_law(steel, steel).friction.values == (0.5, 0.2)
