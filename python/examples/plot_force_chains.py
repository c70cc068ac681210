"""
Force chains in a heap of balls
===============================

A layer of balls between two panes settles in a box. What each contact bears stands in the rows of
:meth:`cairn.World.contacts`; drawn as lines they show the chains that carry the weight, and the directions of the contacts
are the fabric of the heap.
"""

import os

import cairn
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

SHORT = "CAIRN_SHORT" in os.environ
G, WIDTH = 9.81, 1.0
COUNT = 60 if SHORT else 350

settings = cairn.Settings.preset("performance", gravity=G).replace(sleeping=False, damping=0)
world = cairn.World(settings)
world.gravity = 0, 0, -G
glass = world.add_material("glass", 2500)
world.set_default_pair_properties(restitution=0.1, static_friction=0.3, kinetic_friction=0.3)
radius = 0.02
for normal, offset in (([0, 0, 1], 0), ([1, 0, 0], 0), ([-1, 0, 0], -WIDTH), ([0, 1, 0], -1.5 * radius),
                       ([0, -1, 0], -1.5 * radius)):
    world.add_body(cairn.HalfSpace(normal, offset), glass, fixed=True)

# %%
# The balls are of many sizes and begin a little beside their places, so that they do not settle in rows.
random = np.random.default_rng(1)
balls = []
for i in range(COUNT):
    place = [0.05 + 0.045 * (i % 20) + random.uniform(-0.01, 0.01), 0, 0.05 + 0.06 * (i // 20)]
    balls.append(world.add_body(cairn.Sphere(radius * random.uniform(0.6, 1)), glass, position=place))
world.step(240 if SHORT else 1200)

# %%
# Contacts with the ground, the walls and the panes (bodies 0 to 4) are left out of the fabric.
contacts = world.contacts()
force = np.linalg.norm(contacts["impulse"], axis=1) * settings.steps_per_second
a, b = contacts["a"]["index"], contacts["b"]["index"]
centre = world.bodies.centre_of_mass
between = a > 4
weight = G * world.bodies.mass[5:].sum()
on_ground = -contacts["impulse"][a == 0][:, 2].sum() * settings.steps_per_second
print(f"weight {weight:.1f} N, borne by the ground {on_ground:.1f} N")

fig, (left, right) = plt.subplots(1, 2, figsize=(10, 5), gridspec_kw={"width_ratios": [2, 1]})
for ball in balls:
    shape = world.shape(ball)
    assert isinstance(shape, cairn.Sphere)
    left.add_patch(plt.Circle(centre[ball.index, [0, 2]], shape.radius, color="0.9"))
lines = np.stack([centre[a[between]][:, [0, 2]], centre[b[between]][:, [0, 2]]], axis=1)
largest = force[between].max()
left.add_collection(LineCollection(lines, linewidths=5 * force[between] / largest, colors="0.1"))
left.set_aspect("equal")
left.set_xlim(0, WIDTH)
left.set_ylim(0, float(centre[5:, 2].max()) + radius)
left.set_xlabel("x [m]")
left.set_ylabel("z [m]")
left.set_title(f"widest line: {largest:.2f} N")

direction = contacts["normal"][between]
angle = np.degrees(np.arctan2(direction[:, 2], direction[:, 0])) % 180
right.hist(angle, bins=18, range=(0, 180), weights=force[between] / force[between].sum(), color="0.4", label="by force")
right.hist(angle, bins=18, range=(0, 180), weights=np.full(len(angle), 1 / len(angle)), histtype="step", color="0",
           label="by number")
right.set_xlabel("direction of the normal to the horizontal [°]")
right.set_ylabel("part of the contacts")
right.legend()
fig.tight_layout()
plt.show()
