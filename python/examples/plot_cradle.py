"""
Newton's cradle and its energy
==============================

Five steel balls hang side by side. With impacts passed on one after the other, the ball that strikes is answered by the
one at the other end, and the energy that is put in stays.
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
G, RADIUS, LENGTH, TILT = 9.81, 0.02, 0.3, math.radians(40)

# %%
# Each ball hangs on a rod without mass; the first one is raised by 40 degrees.
tops = [np.array([2 * RADIUS * i, 0, 0]) for i in range(5)]
centres = [top - [0, 0, LENGTH] for top in tops]
centres[0] = tops[0] - LENGTH * np.array([math.sin(TILT), 0, math.cos(TILT)])
scene = cairn.Scene(
    "cradle",
    duration=1.5 if SHORT else 4,
    gravity=[0, 0, -G],
    materials=[cairn.Material("steel", 7800)],
    default_pair=cairn.PairProperties(restitution=1, static_friction=0, kinetic_friction=0),
    bodies=[cairn.SceneBody(cairn.Sphere(RADIUS), "steel", position=centre) for centre in centres],
    joints=[cairn.SceneJoint(i, None, cairn.JointDescription("distance", anchor=centres[i], anchor_b=tops[i]))
            for i in range(5)],
    preset="accuracy",
    settings={"impacts": "sequential", "exact_flight": True, "damping": 0, "sleeping": False},
)

times, places, energies = [], [], []
run = cairn.SceneRun(scene)
world = run.world
while world.time < scene.duration:
    run.step(4)
    times.append(world.time)
    places.append(world.bodies.centre_of_mass[:, 0].copy())
    energies.append(world.kinetic_energy() + world.potential_energy())

# %%
# The energy is that of the beginning to a part in a thousand of what the first ball had.
lifted = world.bodies.mass[0] * G * LENGTH * (1 - math.cos(TILT))
change = (np.array(energies) - energies[0]) / lifted
assert abs(change).max() < 1e-3

fig, (upper, lower) = plt.subplots(2, 1, figsize=(7, 5), sharex=True)
for i, style in ((0, "-"), (2, ":"), (4, "--")):
    upper.plot(times, np.array(places)[:, i] - 2 * RADIUS * i, style, label=f"ball {i + 1}")
upper.set_ylabel("displacement [m]")
upper.legend(loc="upper right")
lower.plot(times, 1e6 * change, "-", color="0.3")
lower.set_xlabel("time [s]")
lower.set_ylabel("change of energy\n[10⁻⁶ of that put in]")
fig.tight_layout()
plt.show()

# %%
# The same, recorded.
cairn.run(scene, record="cradle.h5")
