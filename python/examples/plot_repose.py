"""
The angle of repose
===================

Grains that are poured onto a small round base leave a heap whose flank has the angle of repose. It grows with the
friction between the grains, and more so where they also resist rolling: grains that roll freely come down by rolling,
however rough they are (Zhou and others, Physica A 269, 1999).
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

SHORT = "CAIRN_SHORT" in os.environ
Floats = npt.NDArray[np.float64]
G, GRAIN = 9.81, 0.1
BASE = 5 * GRAIN
COUNT, DURATION = (96, 1.5) if SHORT else (400, 5.5)


def scene(friction: float, rolling: float, seed: int) -> cairn.Scene:
    """Grains above a base of grains that are fixed. friction: [1], rolling: length of the rolling friction [radii]"""
    random = np.random.default_rng(seed)
    rows = np.arange(-7, 8)
    base = np.array([[(i + j % 2 / 2) * GRAIN, j * math.sqrt(3) / 2 * GRAIN, 0] for i in rows for j in rows])
    base = base[np.hypot(base[:, 0], base[:, 1]) <= BASE]
    # Layers of 16, a little beside their places, pour themselves.
    cells = np.array([[i % 4 - 1.5, i // 4 % 4 - 1.5, i // 16 + 1.2] for i in range(COUNT)])
    places = 1.1 * GRAIN * cells + random.uniform(-0.04, 0.04, (COUNT, 3)) * GRAIN
    grain = cairn.SceneBody(cairn.Sphere(GRAIN / 2), "glass")
    return cairn.Scene(
        "heap",
        duration=DURATION,
        gravity=[0, 0, -G],
        materials=[cairn.Material("glass", 2500)],
        default_pair=cairn.PairProperties(0.1, friction, friction, rolling * GRAIN / 2, rolling * GRAIN / 2),
        bodies=[*(grain.replace(position=place, fixed=True) for place in base),
                *(grain.replace(position=place) for place in places)],
        settings={"steps_per_second": 480, "penetration_threshold": 1e-3, "sleeping": False, "damping": 0},
    )


def take_away(run: cairn.SceneRun) -> None:
    """What has fallen off the base."""
    height = run.world.bodies.centre_of_mass[:, 2]
    for id in run.ids:
        if id in run.world and height[id.index] < -1:
            run.world.remove_body(id)


# %%
# Rays from above, 36 around the axis at each distance, find the surface of the heap. Its flank is straight between a
# quarter and nine tenths of the base.
RADII = np.linspace(0.05, 1, 20) * BASE


def surface(world: cairn.World) -> Floats:
    """Height over the distance from the axis, shape of RADII [m]."""
    rays = [cairn.Ray([r * math.cos(angle), r * math.sin(angle), 5], [0, 0, -1])
            for r in RADII for angle in np.linspace(0, 2 * math.pi, 36, endpoint=False)]
    hits = world.cast_rays(rays)
    heights = [0 if hit is None else max(hit.point[2], 0) for hit in hits]
    mean: Floats = np.mean(np.reshape(heights, (len(RADII), 36)), axis=1)
    return mean


# %%
# Each heap is another one: the points are means of three, the bars their standard deviation.
FLANK = (RADII > 0.25 * BASE) & (RADII < 0.9 * BASE)
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
frictions = [0.1, 0.8] if SHORT else [0.1, 0.2, 0.4, 0.8]
seeds = range(1 if SHORT else 3)
angles: dict[float, list[float]] = {}
for rolling, style in ((0.0, "o--"), (0.2, "s-")):
    angles[rolling] = []
    for friction in frictions:
        heights, slopes = [], []
        for seed in seeds:
            result = cairn.run(scene(friction, rolling, seed), record="repose.h5", after_frame=take_away)
            heights.append(surface(result.world))
            slopes.append(np.polyfit(RADII[FLANK], heights[-1][FLANK], 1)[0])
        height = np.mean(heights, axis=0)
        each = np.degrees(np.arctan(-np.array(slopes)))
        angles[rolling].append(float(each.mean()))
        right.errorbar(friction, each.mean(), each.std(), color="0.2", capsize=3)
        if friction in (frictions[0], frictions[-1]):
            left.plot(RADII / GRAIN, height / GRAIN, style, markersize=4,
                      color="0.6" if friction == frictions[0] else "0.1",
                      label=f"µ = {friction}, rolling friction {rolling} r")
    right.plot(frictions, angles[rolling], style, color="0.2", label=f"rolling friction {rolling} r")
left.set_xlabel("distance from the axis [grains]")
left.set_ylabel("height of the surface [grains]")
left.legend(fontsize=8)
right.set_xlabel("coefficient of friction")
right.set_ylabel("angle of repose [°]")
right.set_ylim(bottom=0)
right.legend()
fig.tight_layout()
plt.show()
print({rolling: [round(angle, 1) for angle in row] for rolling, row in angles.items()})
# Single heaps differ by some degrees; rough grains that hardly roll and smooth ones that do differ by more.
assert max(angles[0.2]) > angles[0.0][0] + 5

# %%
# The last of the heaps.
assert result.recording is not None
result.recording
