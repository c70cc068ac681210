"""Worlds for the tests."""

from typing import Optional

import cairn


def exact() -> cairn.Settings:
    """Slow bodies feel all of gravity."""
    return cairn.Settings.preset("performance").replace(damping=0)


def ground(settings: Optional[cairn.Settings] = None) -> tuple[cairn.World, cairn.MaterialId]:
    """A world with gravity, one material and a floor, which is body 0."""
    world = cairn.World(settings)
    world.gravity = 0, 0, -10
    oak = world.add_material("oak", 800)
    world.add_body(cairn.HalfSpace(), oak, fixed=True)
    return world, oak


def tower(height: int, settings: Optional[cairn.Settings] = None) -> cairn.World:
    """Boxes upon each other."""
    world, oak = ground(settings)
    for i in range(height):
        world.add_body(cairn.Box([0.2, 0.2, 0.2]), oak, position=[0, 0, 0.1 + 0.2 * i])
    return world
