"""
Force chains and fabric of a sheared packing
============================================

A layer of balls bears its own weight, then its walls are pushed together: the packing is sheared. Lines of force turn
from the upright to the level direction, and so do the directions of the contacts, which are the fabric. Rothenburg and
Bathurst (1989) derived how the strength follows from both: the ratio of the stresses, (σ₁ − σ₃) / (σ₁ + σ₃), is half
the sum of the anisotropies of directions, normal forces and tangential forces.
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

SHORT = "CAIRN_SHORT" in os.environ
Floats = npt.NDArray[np.float64]
G, RADIUS, WIDTH = 9.81, 0.02, 1.0
COUNT, SETTLED, SHEARED = (110, 0.8, 0.3) if SHORT else (420, 1.5, 2.0)
SPEED, FALLEN = 0.04, 0.5

# %%
# Balls of many sizes between two smooth panes, in a box with smooth walls of which two move by a law.
random = np.random.default_rng(1)
radii = RADIUS * random.uniform(0.8, 1, COUNT)
cells = np.stack([np.arange(COUNT) % 22, np.arange(COUNT) // 22], axis=1)
places = np.zeros((COUNT, 3))
places[:, [0, 2]] = (cells + 0.5) * WIDTH / 22 + random.uniform(-0.002, 0.002, (COUNT, 2))
top = 1.05 * places[:, 2].max()
smooth = cairn.PairProperties(restitution=0, static_friction=0, kinetic_friction=0)
glass = cairn.SceneBody(cairn.Sphere(), "glass")
wall = cairn.SceneBody(cairn.Box([0.1, 0.2, 4]), "wall", fixed=True)


def push(direction: int) -> cairn.TableMotion:
    """A wall rests until the packing has settled, then moves at constant speed."""
    start, way = 0.1, SPEED * (SHEARED - 0.05)
    ways = [[direction * x, 0, 0] for x in (0, 0, SPEED * start / 2, way)]
    speeds = [[direction * v, 0, 0] for v in (0, 0, SPEED, SPEED)]
    return cairn.TableMotion([0, SETTLED, SETTLED + start, SETTLED + SHEARED], ways, velocities=speeds)


pane = cairn.SceneBody(cairn.HalfSpace([0, 1, 0], -RADIUS), "wall", fixed=True)
scene = cairn.Scene(
    "biaxial",
    duration=SETTLED + SHEARED,
    gravity=[0, 0, -G],
    materials=[cairn.Material("glass", 2500), cairn.Material("wall", 1000)],
    default_pair=cairn.PairProperties(restitution=0.1, static_friction=0.5, kinetic_friction=0.5),
    pairs={("glass", "wall"): smooth},
    bodies=[
        cairn.SceneBody(cairn.HalfSpace(), "wall", fixed=True),
        pane,
        pane.replace(shape=cairn.HalfSpace([0, -1, 0], -RADIUS)),
        wall.replace(position=[-0.05, 0, 2], motion=push(1)),
        wall.replace(position=[WIDTH + 0.05, 0, 2], motion=push(-1)),
        *(glass.replace(shape=cairn.Sphere(radius), position=place) for radius, place in zip(radii, places)),
    ],
    settings={"steps_per_second": 960, "penetration_threshold": 2e-4, "contact_margin": 1e-5, "iterations": 50,
              "tolerance": 0.05, "sleeping": False, "damping": 0},
)
FIRST = 5


# %%
# From the rows of :meth:`cairn.World.contacts` come force and direction of each contact between two balls, and from
# these the stress (Love, Weber), the fabric and the anisotropies.
def between_balls(world: cairn.World) -> tuple[Floats, Floats, Floats]:
    """In the plane: both centres [m], shape (n, 2, 2), normals and forces on the first [N], shape (n, 2)."""
    contacts = world.contacts()
    contacts = contacts[(contacts["a"]["index"] >= FIRST) & contacts["impulse"].any(axis=1)]
    centre = world.bodies.centre_of_mass[:, [0, 2]]
    ends = np.stack([centre[contacts["a"]["index"]], centre[contacts["b"]["index"]]], axis=1)
    branch = ends[:, 0] - ends[:, 1]
    normal = branch / np.linalg.norm(branch, axis=1, keepdims=True)
    return ends, normal, contacts["impulse"][:, [0, 2]] * world.settings.steps_per_second


def deviator(tensor: Floats) -> float:
    """How much more of it is level than upright, as a part of both."""
    return float((tensor[0, 0] - tensor[1, 1]) / (tensor[0, 0] + tensor[1, 1]))


def anisotropies(world: cairn.World) -> tuple[float, float, float, float]:
    """Of stress, directions, normal and tangential forces; positive where the level direction has more."""
    ends, n, force = between_balls(world)
    stress = np.einsum("ci,cj->ij", force, ends[:, 0] - ends[:, 1])
    fabric = np.einsum("ci,cj->ij", n, n)
    a_c = 2 * deviator(fabric)
    # Forces are averaged over directions, not over contacts: the more contacts share a direction, the less each weighs.
    weight = 1 / (1 + a_c * (n[:, 0] ** 2 - n[:, 1] ** 2))
    normal_force = np.einsum("ci,ci->c", force, n)
    tangential = force - normal_force[:, None] * n
    normal_forces = np.einsum("c,ci,cj->ij", weight * normal_force, n, n)
    tangential_forces = np.einsum("c,ci,cj->ij", weight, tangential, n)
    a_t = 2 * (tangential_forces[0, 0] - tangential_forces[1, 1]) / np.trace(normal_forces)
    return deviator(stress), a_c, 2 * deviator(normal_forces), float(a_t)


# %%
# The packing is looked at after each simulation step of 1/30 s, and drawn before the walls move and at the end.
fig, axes = plt.subplots(2, 2, figsize=(10, 8), gridspec_kw={"width_ratios": [2, 1]})
history = []


def draw(world: cairn.World, chains: Axes, fabric: Axes, title: str) -> None:
    """Lines as wide as the forces, and the parts of the directions."""
    ends, n, force = between_balls(world)
    strength = np.linalg.norm(force, axis=1)
    for centre, radius in zip(world.bodies.centre_of_mass[FIRST:], radii):
        chains.add_patch(plt.Circle(centre[[0, 2]], radius, color="0.9"))
    chains.add_collection(LineCollection(list(ends), linewidths=4 * strength / strength.max(), colors="0.1"))
    chains.set(aspect="equal", xlim=(0, WIDTH), ylim=(0, top), xlabel="x [m]", ylabel="z [m]",
               title=f"{title}; widest line {strength.max():.0f} N")
    angle = np.degrees(np.arctan2(n[:, 1], n[:, 0])) % 180
    fabric.hist(angle, bins=18, range=(0, 180), weights=strength / strength.sum(), color="0.6", label="by force")
    fabric.hist(angle, bins=18, range=(0, 180), weights=np.full(len(angle), 1 / len(angle)), histtype="step", color="0",
                label="by number")
    fabric.set(xlabel="direction of the normal to the level [°]", ylabel="part of the contacts")
    fabric.legend()


def look(run: cairn.SceneRun) -> None:
    # The balls have fallen by then.
    if run.world.time > FALLEN:
        history.append((run.world.time, *anisotropies(run.world)))
    if abs(run.world.time - SETTLED) < 1e-6:
        draw(run.world, axes[0, 0], axes[0, 1], "under its own weight")


result = cairn.run(scene, record="packing.h5", after_frame=look)
draw(result.world, axes[1, 0], axes[1, 1], "walls pushed together")
fig.tight_layout()
plt.show()

# %%
# What the contacts say of the strength is what the stresses are.
time, stress, *parts = np.array(history).T
half = sum(parts) / 2
assert np.abs(stress - half).mean() < 0.03
fig, over_time = plt.subplots(figsize=(7, 4))
over_time.plot(time, stress, "-", color="0.1", label="stress: (σ₁ − σ₃) / (σ₁ + σ₃), level less upright")
over_time.plot(time, half, "--", color="0.5", linewidth=3, zorder=0, label="half the sum of the anisotropies")
for values, style, name in zip(parts, ("-.", ":", (0, (1, 3))), ("directions", "normal forces", "tangential forces")):
    over_time.plot(time, values / 2, linestyle=style, color="0.4", linewidth=1, label=f"half that of {name}")
over_time.axvline(SETTLED, color="0.8", linewidth=1)
over_time.set(xlabel="time [s]", ylabel="anisotropy")
over_time.legend(fontsize=8)
fig.tight_layout()
plt.show()

# %%
# The whole test.
result
