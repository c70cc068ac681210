"""
The least thickness of an arch
==============================

A semicircular arch stands under its own weight as long as a line of thrust fits into it: for thicknesses above 0.1075
of its mean radius (Milankovitch 1907; Ochsendorf 2002 tells the history). Simulated voussoirs find the same border.
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
G, COUNT, DEPTH, THEORY = 9.81, 21, 0.2, 0.1075


def voussoirs(thickness: float) -> list[cairn.ConvexHull]:
    """Of an arch with the mean radius 1 m. thickness: [m]"""
    joints = np.linspace(0, math.pi, COUNT + 1)
    radii = (1 - thickness / 2, 1 + thickness / 2)
    return [
        cairn.ConvexHull([[r * math.cos(angle), y, r * math.sin(angle)]
                          for r in radii for angle in pair for y in (-DEPTH / 2, DEPTH / 2)])
        for pair in zip(joints[:-1], joints[1:])
    ]


def scene(thickness: float) -> cairn.Scene:
    """The arch on the ground. thickness: [m]"""
    return cairn.Scene(
        "arch",
        duration=1 if SHORT else 2,
        gravity=[0, 0, -G],
        materials=[cairn.Material("stone", 2000)],
        default_pair=cairn.PairProperties(restitution=0, static_friction=1, kinetic_friction=1),
        bodies=[cairn.SceneBody(cairn.HalfSpace(), "stone", fixed=True),
                *(cairn.SceneBody(voussoir, "stone") for voussoir in voussoirs(thickness))],
        preset="accuracy",
        settings={"damping": 0, "sleeping": False},
    )


def sinking(thickness: float) -> tuple[list[float], list[float]]:
    """How far the keystone has sunk over time [s], [m], until it has fallen by a tenth of the radius."""
    run = cairn.SceneRun(scene(thickness))
    height = run.world.bodies.centre_of_mass[:, 2]
    keystone, times, sunk = 1 + COUNT // 2, [0.0], [0.0]
    begin = float(height[keystone])
    while run.world.time < run.scene.duration and sunk[-1] < 0.1:
        run.step(10)
        times.append(run.world.time)
        sunk.append(begin - float(height[keystone]))
    return times, sunk


# %%
# Halving the interval between an arch that falls and one that stands finds the border.
lower, upper = 0.08, 0.14
fig, axes = plt.subplots(figsize=(7, 4))
for _ in range(2 if SHORT else 7):
    thickness = (lower + upper) / 2
    times, sunk = sinking(thickness)
    falls = sunk[-1] >= 0.1
    lower, upper = (thickness, upper) if falls else (lower, thickness)
    axes.semilogy(times, np.maximum(sunk, 1e-7), "--" if falls else "-", color=f"{0.8 - 0.1 * len(axes.lines):.1f}",
                  label=f"thickness {thickness:.4f} of the radius: {'falls' if falls else 'stands'}")
assert lower < 1.05 * THEORY and upper > 0.95 * THEORY
print(f"falls at {lower:.4f}, stands at {upper:.4f}; theory: {THEORY}")
axes.set_xlabel("time [s]")
axes.set_ylabel("sinking of the keystone [m]")
axes.legend(fontsize=8)
fig.tight_layout()
plt.show()

# %%
# An arch that is a fifth too thin falls as four bars with hinges between them.
cairn.run(scene(0.8 * THEORY), record="arch.h5")
