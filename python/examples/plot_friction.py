"""
A sweep over friction
=====================

A box slides to rest over v² / (2 µ g). :func:`cairn.sweep` runs all combinations of friction and speed on all
processors and returns a table.
"""

import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
G = 9.81
settings = cairn.Settings.preset("accuracy", gravity=G).replace(damping=0)

# %%
# One function makes a world of the parameters, another one measures it.


def make(friction: float, speed: float) -> cairn.World:
    world = cairn.World(settings)
    world.gravity = 0, 0, -G
    oak = world.add_material("oak", 800)
    world.set_default_pair_properties(restitution=0, static_friction=friction, kinetic_friction=friction)
    world.add_body(cairn.HalfSpace(), oak, fixed=True)
    world.add_body(cairn.Box([0.4, 0.4, 0.05]), oak, position=[0, 0, 0.025], linear_velocity=[speed, 0, 0])
    return world


def distance(world: cairn.World) -> dict[str, float]:
    while not world.bodies.asleep[1]:
        world.step()
    return {"distance": float(world.bodies.centre_of_mass[1, 0])}


speeds = [1.0, 2.0] if SHORT else [1.0, 2.0, 3.0]
table = cairn.sweep(make, {"speed": speeds, "friction": [0.1, 0.2, 0.4, 0.8]}, distance)
print(table)

# %%
# The lines are the closed form.
fig, axes = plt.subplots(figsize=(7, 4))
friction = np.geomspace(0.08, 1, 50)
for speed, marker, style in zip(speeds, "o^s", ("-", "--", ":")):
    rows = [row for row in table if row["speed"] == speed]
    axes.loglog(friction, speed**2 / (2 * friction * G), style, color="0.4")
    axes.loglog([row["friction"] for row in rows], [row["distance"] for row in rows], marker, label=f"{speed} m/s")
closed = table.column("speed") ** 2 / (2 * table.column("friction") * G)
assert np.allclose(table.column("distance"), closed, rtol=0.02)
axes.set_xlabel("coefficient of friction")
axes.set_ylabel("distance [m]")
axes.legend(title="simulated")
fig.tight_layout()
plt.show()
