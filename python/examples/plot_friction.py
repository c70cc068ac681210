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
FRICTIONS = [0.1, 0.2, 0.4, 0.8]

# %%
# One function makes a world of the parameters, another one measures it.


def scene(frictions: list[float], speed: float) -> cairn.Scene:
    """Boxes that slide side by side, each with a friction of its own. speed: [m/s]"""
    oak = [f"oak {friction}" for friction in frictions]
    return cairn.Scene(
        "sliding",
        duration=1 if SHORT else 2.5,
        gravity=[0, 0, -G],
        materials=[cairn.Material("ground", 2000), *(cairn.Material(name, 800) for name in oak)],
        pairs={("ground", name): cairn.PairProperties(0, friction, friction) for name, friction in zip(oak, frictions)},
        bodies=[
            cairn.SceneBody(cairn.HalfSpace(), "ground", fixed=True),
            *(cairn.SceneBody(cairn.Box([0.4, 0.4, 0.05]), name, position=[0, 0.6 * i, 0.025],
                              linear_velocity=[speed, 0, 0]) for i, name in enumerate(oak)),
        ],
        preset="accuracy",
        settings={"damping": 0},
    )


def make(friction: float, speed: float) -> cairn.World:
    return cairn.SceneRun(scene([friction], speed)).world


def distance(world: cairn.World) -> dict[str, float]:
    while not world.bodies.asleep[1]:
        world.step()
    return {"distance": float(world.bodies.centre_of_mass[1, 0])}


speeds = [1.0, 2.0] if SHORT else [1.0, 2.0, 3.0]
table = cairn.sweep(make, {"speed": speeds, "friction": FRICTIONS}, distance)
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

# %%
# The four boxes at 2 m/s, side by side.
cairn.run(scene(FRICTIONS, 2), record="friction.h5")
