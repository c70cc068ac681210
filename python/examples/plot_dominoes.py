"""
The wave of falling dominoes
============================

Dominoes in a row fall in a wave whose speed, a few blocks after the beginning, no longer depends on how the first was
pushed. It grows with the square root of their height, and is larger where they stand closer.
"""

import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
G = 9.81
THICKNESS, WIDTH, HEIGHT = 0.03, 0.1, 0.2
COUNT = 12 if SHORT else 30


def scene(gap: float) -> cairn.Scene:
    """A row of dominoes, so far apart [m], of which the first one turns about its lower edge."""
    spin = 2.5
    push = {"linear_velocity": [spin * HEIGHT / 2, 0, spin * THICKNESS / 2], "angular_velocity": [0, spin, 0]}
    domino = cairn.SceneBody(cairn.Box([THICKNESS, WIDTH, HEIGHT]), "wood")
    row = [domino.replace(position=[i * (THICKNESS + gap), 0, HEIGHT / 2]) for i in range(COUNT)]
    return cairn.Scene(
        "dominoes",
        duration=1 if SHORT else 3,
        gravity=[0, 0, -G],
        materials=[cairn.Material("wood", 700)],
        default_pair=cairn.PairProperties(restitution=0, static_friction=0.3, kinetic_friction=0.3),
        bodies=[cairn.SceneBody(cairn.HalfSpace(), "wood", fixed=True), row[0].replace(**push), *row[1:]],
        preset="accuracy",
    )


def fall(gap: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """When each domino has tilted by a tenth of a radian [s]."""
    run = cairn.SceneRun(scene(gap))
    fallen = np.full(COUNT, np.nan)
    while np.isnan(fallen[-1]) and run.world.time < 5:
        run.step(4)
        _, orientations = run.world.bodies.poses()
        tilt = 2 * np.abs(np.arctan2(orientations[1:, 2], orientations[1:, 0]))
        fallen[(tilt > 0.1) & np.isnan(fallen)] = run.world.time
    return fallen


# %%
# The slope of the line through all but the first dominoes is the speed of the wave.
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
gaps = [0.05] if SHORT else [0.03, 0.05, 0.08, 0.11]
speeds = []
for gap, marker in zip(gaps, "o^sv"):
    fallen = fall(gap)
    assert not np.isnan(fallen).any()
    places = np.arange(COUNT) * (THICKNESS + gap)
    speeds.append(float(np.polyfit(fallen[5:], places[5:], 1)[0]))
    left.plot(fallen, places, marker, markersize=4, label=f"gap {1e3 * gap:.0f} mm")
left.set_xlabel("time [s]")
left.set_ylabel("place of the domino that falls [m]")
left.legend()
right.plot(np.array(gaps) / HEIGHT, np.array(speeds) / np.sqrt(G * HEIGHT), "o-", color="0.2")
right.set_xlabel("gap / height")
right.set_ylabel("speed / √(g height)")
right.set_ylim(0, 2)
fig.tight_layout()
plt.show()

# %%
# One of the rows, as it falls.
cairn.run(scene(0.05), record="dominoes.h5")
