"""A box falls, comes to rest, and says where."""

import cairn

world = cairn.World()
world.gravity = 0, 0, -10
oak = world.add_material("oak", density=800)
world.add_body(cairn.HalfSpace(), oak, fixed=True)
box = world.add_body(cairn.Box([0.2, 0.2, 0.2]), oak, position=[0, 0, 1])

while not world.is_asleep(box):
    world.step()
print(f"at rest after {world.time:.2f} s at a height of {world.pose(box).position[2]:.2f} m")
