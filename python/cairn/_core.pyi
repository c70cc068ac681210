"""The compiled part of the package: the public interface of the C++ library. Right-handed, SI units; W is the world's
frame, B a body's: centre of mass, principal axes. Quaternions are (w, x, y, z) unless a name says otherwise. Arrays of
records are read-only."""

import enum
from typing import Any, Iterator, Mapping, Optional, Sequence, TypeVar, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._types import EventAction, FilePath, Floats, Ids, Motion, SettingValue, Shape, Structured

_Self = TypeVar("_Self")

version: str
stage_names: tuple[str, ...]
most_groups: int
simulation_steps_per_second: float
body_id_dtype: np.dtype[np.void]
contact_dtype: np.dtype[np.void]
event_dtype: np.dtype[np.void]

class _Vector:
    def __get__(self, world: World, owner: Any) -> Floats: ...
    def __set__(self, world: World, value: ArrayLike) -> None: ...

class _EventLevel:
    def __get__(self, world: World, owner: Any) -> EventLevel: ...
    def __set__(self, world: World, value: Union[EventLevel, str]) -> None: ...

class InputError(ValueError):
    """What was given is not allowed; the text names the value and the remedy."""

class StaleIdError(InputError, LookupError):
    """An id names a body, spring or joint that is no longer (or was never) in the world."""

class IoError(OSError):
    """A file cannot be read or written, or a disk is full."""

class InvariantError(RuntimeError):
    """A mistake of Cairn itself, found by World.set_checks()."""

class _Record:
    """A frozen record: equal if all fields are, shown as written."""

    __match_args__: tuple[str, ...]
    def replace(self: _Self, **changes: Any) -> _Self:
        """A copy in which the named fields have other values."""
    def __eq__(self, other: object) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

class BodyKind(enum.IntEnum):
    """What a slot of a world holds."""

    hole = 0
    fixed = 1
    dynamic = 2

class WakeReason(enum.IntEnum):
    """Why a body woke."""

    none = 0
    changed = 1
    displaced = 2
    struck = 3
    neighbour_removed = 4
    support_lost = 5
    floating = 6

class EventKind(enum.IntEnum):
    """What happened."""

    contact_begun = 0
    contact_persisted = 1
    contact_ended = 2
    woke = 3
    fell_asleep = 4
    frozen = 5
    joint_broke = 6
    sensor_entered = 7
    sensor_left = 8

class EventLevel(enum.IntEnum):
    """Which events a world collects; each level has those before it."""

    none = 0
    changes = 1
    all = 2

class JointKind(enum.IntEnum):
    """What a joint keeps."""

    distance = 0
    rope = 1
    ball = 2
    hinge = 3
    slider = 4
    fixed = 5
    universal = 6
    planar = 7
    cylindrical = 8
    screw = 9
    generic = 10
    gear = 11
    rack = 12
    mimic = 13

class JointAlong(enum.IntEnum):
    """Along or about which axis of a joint's frame A can move relative to B."""

    x = 0
    y = 1
    z = 2
    turn_x = 3
    turn_y = 4
    turn_z = 5

class Touch(enum.IntEnum):
    """Whether two bodies may touch."""

    never = 0
    always = 1

class TableEnd(enum.IntEnum):
    """What a table of motion does after its last time."""

    hold = 0
    repeat = 1

class DriveOf(enum.IntEnum):
    """What follows a function of time."""

    position = 0
    speed = 1
    force = 2
    torque = 3

class Baseline(enum.IntEnum):
    """How an accelerogram is brought to an end."""

    none = 0
    at_rest = 1

class SurfaceSides(enum.IntEnum):
    """Which sides of a surface touch others."""

    one = 0
    two = 1

class Stage(enum.IntEnum):
    """The nine stages of a time step, in order."""

    events = 0
    positions = 1
    detection = 2
    batches = 3
    correction = 4
    velocities = 5
    resolution = 6
    sleeping = 7
    output = 8

class Fold(enum.IntEnum):
    """How several steps become one number."""

    sum = 0
    newest = 1
    largest = 2

class Tracing(enum.IntEnum):
    """Whether steps note what the response did with every body."""

    off = 0
    on = 1

class Checks(enum.IntEnum):
    """Whether a step checks itself."""

    off = 0
    state = 1
    on = 2

class Preset(enum.IntEnum):
    """Where all settings begin."""

    performance = 0
    accuracy = 1
    thesis = 2
    thesis_accuracy = 3

class CorrectionKind(enum.IntEnum):
    """Which penetration correction runs."""

    propagated = 0
    none = 1
    position_sweeps = 2

class ResolutionKind(enum.IntEnum):
    """How closing contacts are resolved."""

    impulse_queue = 0
    arbitrary_order = 1
    sweep = 2
    accelerated_sweeps = 3
    none = 4

class RestitutionLaw(enum.IntEnum):
    """What the coefficient of restitution says: a ratio of speeds or of works."""

    newton = 0
    energetic = 1

class RestitutionSpeed(enum.IntEnum):
    """Which speed restitution takes for that of the impact."""

    closing = 0
    touching = 1

class Impacts(enum.IntEnum):
    """How impacts pass through chains of touching bodies."""

    of_resolution = 0
    sequential = 1
    simultaneous = 2

class BodyId(_Record):
    """A stable name of a body: it never names another body."""

    def __init__(self, index: int = ..., generation: int = ...) -> None: ...
    @property
    def index(self) -> int:
        """Slot in the world."""
    @property
    def generation(self) -> int:
        """How many others lived in the slot before."""
    def __lt__(self: _Self, other: _Self) -> bool: ...
    def __hash__(self) -> int: ...

class SpringId(_Record):
    """A stable name of a spring."""

    def __init__(self, index: int = ..., generation: int = ...) -> None: ...
    @property
    def index(self) -> int:
        """Slot in the world."""
    @property
    def generation(self) -> int:
        """How many others lived in the slot before."""
    def __lt__(self: _Self, other: _Self) -> bool: ...
    def __hash__(self) -> int: ...

class JointId(_Record):
    """A stable name of a joint."""

    def __init__(self, index: int = ..., generation: int = ...) -> None: ...
    @property
    def index(self) -> int:
        """Slot in the world."""
    @property
    def generation(self) -> int:
        """How many others lived in the slot before."""
    def __lt__(self: _Self, other: _Self) -> bool: ...
    def __hash__(self) -> int: ...

class MaterialId:
    """The index of a material of a world."""

    def __init__(self, index: int) -> None: ...
    @property
    def index(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Pose(_Record):
    """Position and orientation of a frame F in another frame."""

    def __init__(self, position: ArrayLike = ..., orientation: ArrayLike = ...) -> None: ...
    @property
    def position(self) -> Floats:
        """Origin of F [m], shape (3,)."""
    @property
    def orientation(self) -> Floats:
        """Rotation from F: a quaternion (w, x, y, z)."""
    @overload
    def to_outer(self, p: ArrayLike) -> Floats:
        """Maps a point [m] or a pose of the posed frame into the outer frame."""
    @overload
    def to_outer(self, p: Pose) -> Pose: ...
    def to_inner(self, p: ArrayLike) -> Floats:
        """Maps a point of the outer frame [m] into the posed frame."""
    def inverse(self) -> Pose:
        """The pose of the outer frame in the posed one."""

class Sphere(_Record):
    """A ball about the origin of its frame."""

    def __init__(self, radius: float = ...) -> None: ...
    @property
    def radius(self) -> float:
        """[m], > 0"""

class Box(_Record):
    """A cuboid about the origin of its frame, its edges along the axes."""

    def __init__(self, size: ArrayLike = ...) -> None: ...
    @property
    def size(self) -> Floats:
        """Full edge lengths [m], each > 0."""

class Capsule(_Record):
    """A cylinder along z with a half ball on each end."""

    def __init__(self, radius: float = ..., length: float = ...) -> None: ...
    @property
    def radius(self) -> float:
        """[m], > 0"""
    @property
    def length(self) -> float:
        """Of the cylindrical part, without the half balls [m], > 0."""

class Cylinder(_Record):
    """A cylinder about the origin of its frame, its axis along z."""

    def __init__(self, radius: float = ..., length: float = ...) -> None: ...
    @property
    def radius(self) -> float:
        """[m], > 0"""
    @property
    def length(self) -> float:
        """Along the axis [m], > 0."""

class HalfSpace(_Record):
    """All points p with normal·p ≤ offset are solid; always fixed, has no mass."""

    def __init__(self, normal: ArrayLike = ..., offset: float = ...) -> None: ...
    @property
    def normal(self) -> Floats:
        """Outward, of any length > 0."""
    @property
    def offset(self) -> float:
        """Distance of the plane from the origin along the normal [m]."""

class ConvexHull(_Record):
    """The smallest convex solid that holds some points, in any frame and order."""

    def __init__(self, points: ArrayLike) -> None: ...
    @property
    def points(self) -> Floats:
        """As given [m], shape (n, 3)."""
    @property
    def corners(self) -> Floats:
        """The points that are corners of the solid [m], shape (m, 3)."""

class SurfaceRepairs(_Record):
    """What was mended when a surface was built."""

    def __init__(
        self, welded: int = ..., degenerate: int = ..., duplicate: int = ..., open_edges: int = ...
    ) -> None: ...
    @property
    def welded(self) -> int:
        """Vertices at the place of another one, or of no triangle."""
    @property
    def degenerate(self) -> int:
        """Triangles without an area, left out."""
    @property
    def duplicate(self) -> int:
        """Triangles given before, left out."""
    @property
    def open_edges(self) -> int:
        """Edges without exactly one neighbour of the same orientation."""

class Mesh(_Record):
    """A surface of triangles; its body is fixed and may have a motion."""

    def __init__(
        self,
        vertices: ArrayLike,
        triangles: ArrayLike,
        sides: Union[SurfaceSides, str] = ...,
        scale: ArrayLike = ...,
    ) -> None: ...
    @property
    def vertices(self) -> Floats:
        """Those kept, scaled [m], shape (n, 3)."""
    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Those kept: indices of vertices, shape (m, 3); the parts of questions."""
    @property
    def sides(self) -> SurfaceSides:
        """Which sides touch others."""
    @property
    def repairs(self) -> SurfaceRepairs:
        """What was mended."""
    @property
    def bytes(self) -> int:
        """Of memory that copies share."""

class HeightField(_Record):
    """Ground given by heights over a grid about the origin; otherwise as a mesh."""

    def __init__(self, heights: ArrayLike, spacing: ArrayLike) -> None: ...
    @property
    def heights(self) -> Floats:
        """[m], shape (rows, columns): rows along y, columns along x."""
    @property
    def spacing(self) -> Floats:
        """Of columns and rows [m], shape (2,)."""
    @property
    def columns(self) -> int:
        """Along x."""
    @property
    def rows(self) -> int:
        """Along y."""
    @property
    def vertices(self) -> Floats:
        """One per height [m], shape (n, 3)."""
    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Two per cell: indices of vertices, shape (m, 3); the parts of questions."""
    @property
    def bytes(self) -> int:
        """Of memory that copies share."""

def read_mesh(file: FilePath, sides: Union[SurfaceSides, str] = ..., scale: ArrayLike = ...) -> Mesh:
    """Reads a mesh from an STL, OBJ or PLY file."""

def parse_mesh(bytes: bytes, source: str, sides: Union[SurfaceSides, str] = ..., scale: ArrayLike = ...) -> Mesh:
    """The same of a file's content."""

def read_height_field(file: FilePath, spacing: ArrayLike, scale: float) -> HeightField:
    """Reads heights from a greyscale PNG whose white is so high [m]."""

def parse_height_field(bytes: bytes, source: str, spacing: ArrayLike, scale: float) -> HeightField:
    """The same of a file's content."""

class SolidProperties(_Record):
    """Volume, centre and inertia of a solid of density 1."""

    def __init__(self, volume: float, centre: ArrayLike, inertia: ArrayLike) -> None: ...
    @property
    def volume(self) -> float:
        """[m³], > 0"""
    @property
    def centre(self) -> Floats:
        """Of mass [m, frame of the shape], shape (3,)."""
    @property
    def inertia(self) -> Floats:
        """About the centre [m⁵], shape (3, 3)."""

class CompoundPart(_Record):
    """A shape of a compound."""

    def __init__(
        self,
        shape: Shape,
        pose: Pose = ...,
        mass: Optional[float] = ...,
        density: Optional[float] = ...,
    ) -> None: ...
    @property
    def shape(self) -> Shape:
        """Any solid but compounds."""
    @property
    def pose(self) -> Pose:
        """Of the shape in the compound's frame."""
    @property
    def mass(self) -> Optional[float]:
        """[kg], > 0"""
    @property
    def density(self) -> Optional[float]:
        """In place of a mass [kg/m³], > 0; without either that of the material."""

class Compound(_Record):
    """Several shapes that move as one body."""

    def __init__(self, parts: Sequence[CompoundPart], solid: Optional[SolidProperties] = ...) -> None: ...
    @property
    def parts(self) -> tuple[CompoundPart, ...]:
        """At least one."""
    @property
    def solid(self) -> Optional[SolidProperties]:
        """What the parts stand for, whose mass counts in place of theirs."""

class DecompositionOptions(_Record):
    """How finely a solid is divided."""

    def __init__(self, largest_error: float = ..., most_parts: int = ..., hull_if_open: bool = ...) -> None: ...
    @property
    def largest_error(self) -> float:
        """By how much the parts together may exceed the volume of the mesh, as a part of it; 0 to 1."""
    @property
    def most_parts(self) -> int:
        """Which comes before the error; 1 to 1000."""
    @property
    def hull_if_open(self) -> bool:
        """Takes the hull of a mesh that is not watertight, which is refused otherwise."""

class Decomposition(_Record):
    """A solid in convex parts, and how well they fit."""

    def __init__(
        self,
        compound: Compound,
        volume: float = ...,
        parts_volume: float = ...,
        error: float = ...,
        turned: bool = ...,
        took_hull: bool = ...,
    ) -> None: ...
    @property
    def compound(self) -> Compound:
        """Of hulls, in the frame of the mesh, with the mass, centre and inertia of the mesh."""
    @property
    def volume(self) -> float:
        """Of the mesh [m³]; where it is taken as its hull, that of the hull."""
    @property
    def parts_volume(self) -> float:
        """Of all parts; where two overlap it counts twice [m³]."""
    @property
    def error(self) -> float:
        """parts_volume beyond the volume, as a part of it."""
    @property
    def turned(self) -> bool:
        """The mesh was inside out: all of its triangles were turned."""
    @property
    def took_hull(self) -> bool:
        """The mesh is not watertight."""

def decompose(mesh: Mesh, options: DecompositionOptions = ...) -> Decomposition:
    """Divides the solid inside a mesh into convex parts, which leave out nothing of it."""

def volume_error_of(compound: Compound) -> float:
    """By how much the volumes of all parts exceed that of the solid they stand for, as a part of it."""

class Material(_Record):
    """What a body is made of."""

    def __init__(self, name: str, density: float) -> None: ...
    @property
    def name(self) -> str:
        """Unique in a world, not empty."""
    @property
    def density(self) -> float:
        """[kg/m³], > 0"""

class SpeedCurve(_Record):
    """A value that depends on a speed: on straight lines between points, constant beyond them."""

    def __init__(self, speeds: Sequence[float] = ..., values: Sequence[float] = ...) -> None: ...
    @property
    def speeds(self) -> tuple[float, ...]:
        """[m/s], ≥ 0, ascending; none = the property does not depend on speed."""
    @property
    def values(self) -> tuple[float, ...]:
        """As many."""

class PairLaw(_Record):
    """How properties of a pair depend on the velocity at a contact."""

    def __init__(self, restitution: SpeedCurve = ..., friction: SpeedCurve = ...) -> None: ...
    @property
    def restitution(self) -> SpeedCurve:
        """Over the speed with which they close; values 0 to 1."""
    @property
    def friction(self) -> SpeedCurve:
        """Kinetic friction over the speed with which they slide."""

class PairProperties(_Record):
    """Contact properties of a pair of materials."""

    def __init__(
        self,
        restitution: float = ...,
        static_friction: float = ...,
        kinetic_friction: float = ...,
        rolling_friction: float = ...,
        spinning_friction: float = ...,
    ) -> None: ...
    @property
    def restitution(self) -> float:
        """Coefficient of restitution, 0 to 1."""
    @property
    def static_friction(self) -> float:
        """Coulomb's µs, ≥ 0."""
    @property
    def kinetic_friction(self) -> float:
        """Coulomb's µk, 0 to µs."""
    @property
    def rolling_friction(self) -> float:
        """Greatest torque against rolling over the normal force [m], ≥ 0."""
    @property
    def spinning_friction(self) -> float:
        """Likewise for the torque about the normal [m], ≥ 0."""

class BodyDescription(_Record):
    """How a body begins."""

    def __init__(
        self,
        shape: Shape = ...,
        material: MaterialId = ...,
        mass: Optional[float] = ...,
        centre_of_mass: Optional[ArrayLike] = ...,
        inertia: Optional[ArrayLike] = ...,
        pose: Pose = ...,
        linear_velocity: ArrayLike = ...,
        angular_velocity: ArrayLike = ...,
        fixed: bool = ...,
        asleep: bool = ...,
        name: str = ...,
        groups: Sequence[GroupId] = ...,
        sensor: bool = ...,
        gravity_factor: float = ...,
        linear_damping: float = ...,
        angular_damping: float = ...,
        user_data: int = ...,
        motion: Optional[Motion] = ...,
        pivot: ArrayLike = ...,
        surface_velocity: ArrayLike = ...,
        locked: Sequence[Union[JointAlong, str]] = ...,
    ) -> None: ...
    @property
    def shape(self) -> Shape:
        """In its own frame."""
    @property
    def material(self) -> MaterialId:
        """Must exist in the world."""
    @property
    def mass(self) -> Optional[float]:
        """[kg], > 0; otherwise density times volume."""
    @property
    def centre_of_mass(self) -> Optional[Floats]:
        """[m, frame of the shape]; otherwise that of the uniform solid."""
    @property
    def inertia(self) -> Optional[Floats]:
        """About the centre of mass [kg·m², axes of the shape's frame], shape (3, 3)."""
    @property
    def pose(self) -> Pose:
        """Of the shape's frame in W."""
    @property
    def linear_velocity(self) -> Floats:
        """Of the centre of mass [m/s, W]."""
    @property
    def angular_velocity(self) -> Floats:
        """[rad/s, W]"""
    @property
    def fixed(self) -> bool:
        """Never moves, infinite mass; half-spaces must be fixed."""
    @property
    def asleep(self) -> bool:
        """Begins asleep; its velocities must be zero."""
    @property
    def name(self) -> str:
        """Free, for messages and viewers."""
    @property
    def groups(self) -> tuple[GroupId, ...]:
        """Any number; none = touches the bodies of all groups."""
    @property
    def sensor(self) -> bool:
        """Touches nobody; World.sensed() and events say who is inside."""
    @property
    def gravity_factor(self) -> float:
        """Of the global accelerations that it feels, -1e3 to 1e3; 0 = weightless."""
    @property
    def linear_damping(self) -> float:
        """Rate at which the linear velocity decays [1/s], 0 to 1e6."""
    @property
    def angular_damping(self) -> float:
        """Rate at which the angular velocity decays [1/s], 0 to 1e6."""
    @property
    def user_data(self) -> int:
        """A number of the user's own, 0 to 2⁶⁴ - 1."""
    @property
    def motion(self) -> Optional[Motion]:
        """Of a fixed body: the law by which it moves."""
    @property
    def pivot(self) -> Floats:
        """Of the motion [m, frame of the shape]."""
    @property
    def surface_velocity(self) -> Floats:
        """Of a fixed body: with which its surface runs over it [m/s, frame of the shape]."""
    @property
    def locked(self) -> tuple[JointAlong, ...]:
        """Axes of W along and about which a dynamic body does not move."""

class SpringDescription(_Record):
    """A damped spring between two points."""

    def __init__(
        self,
        a: BodyId,
        anchor_a: ArrayLike = ...,
        b: Optional[BodyId] = ...,
        anchor_b: ArrayLike = ...,
        stiffness: float = ...,
        damping: float = ...,
        rest_length: float = ...,
    ) -> None: ...
    @property
    def a(self) -> BodyId:
        """First body."""
    @property
    def anchor_a(self) -> Floats:
        """[m, frame of A's pose]"""
    @property
    def b(self) -> Optional[BodyId]:
        """Second body; None = a point of the world."""
    @property
    def anchor_b(self) -> Floats:
        """[m, frame of B's pose, or W without a second body]"""
    @property
    def stiffness(self) -> float:
        """[N/m], ≥ 0"""
    @property
    def damping(self) -> float:
        """Along the spring [N·s/m], ≥ 0."""
    @property
    def rest_length(self) -> float:
        """[m], ≥ 0"""

class JointMotor(_Record):
    """Drives a free axis at a speed, as far as its force reaches."""

    def __init__(self, speed: float = ..., limit: float = ...) -> None: ...
    @property
    def speed(self) -> float:
        """Of A relative to B about or along the axis [rad/s or m/s]."""
    @property
    def limit(self) -> float:
        """Largest torque or force [N·m or N], ≥ 0."""

class JointServo(_Record):
    """Drives a free axis to a position, at a speed, or both; stable whatever the gains are."""

    def __init__(
        self,
        position: float = ...,
        speed: float = ...,
        stiffness: float = ...,
        damping: float = ...,
        limit: float = ...,
    ) -> None: ...
    @property
    def position(self) -> float:
        """Wanted [rad or m]."""
    @property
    def speed(self) -> float:
        """Wanted [rad/s or m/s]."""
    @property
    def stiffness(self) -> float:
        """Gain of the position [N·m/rad or N/m], 0 to 1e30; 0 = it drives a speed only."""
    @property
    def damping(self) -> float:
        """Gain of the speed [N·m·s/rad or N·s/m], 0 to 1e30."""
    @property
    def limit(self) -> float:
        """Largest torque or force [N·m or N], ≥ 0."""
    no_limit: float

class JointSpring(_Record):
    """Pulls a free axis to a position; stable whatever the stiffness is."""

    def __init__(self, stiffness: float = ..., rest: float = ...) -> None: ...
    @property
    def stiffness(self) -> float:
        """[N·m/rad or N/m], 0 to 1e30"""
    @property
    def rest(self) -> float:
        """Position without force [rad or m]."""

class JointAxis(_Record):
    """What acts along or about one free axis of a joint."""

    def __init__(
        self,
        along: Union[JointAlong, str] = ...,
        lower: Optional[float] = ...,
        upper: Optional[float] = ...,
        restitution: float = ...,
        motor: Optional[JointMotor] = ...,
        servo: Optional[JointServo] = ...,
        spring: Optional[JointSpring] = ...,
        damping: float = ...,
        friction: float = ...,
        rotor_inertia: float = ...,
    ) -> None: ...
    @property
    def along(self) -> JointAlong:
        """Of generic joints: which axis is free."""
    @property
    def lower(self) -> Optional[float]:
        """Least position [rad or m]."""
    @property
    def upper(self) -> Optional[float]:
        """Greatest position [rad or m], ≥ lower."""
    @property
    def restitution(self) -> float:
        """Part of the speed with which a limit throws back, 0 to 1."""
    @property
    def motor(self) -> Optional[JointMotor]:
        """Drives at a speed; an axis has a motor or a servo."""
    @property
    def servo(self) -> Optional[JointServo]:
        """Drives to a position or at a speed."""
    @property
    def spring(self) -> Optional[JointSpring]:
        """Pulls to a position."""
    @property
    def damping(self) -> float:
        """Force per speed [N·m·s/rad or N·s/m], 0 to 1e30."""
    @property
    def friction(self) -> float:
        """Largest torque or force of dry friction [N·m or N], ≥ 0."""
    @property
    def rotor_inertia(self) -> float:
        """Of what turns with the axis [kg·m² or kg], 0 to 1e30."""

class JointDescription(_Record):
    """How a joint begins, in W as the bodies stand then."""

    def __init__(
        self,
        kind: Union[JointKind, str] = ...,
        a: BodyId = ...,
        b: Optional[BodyId] = ...,
        anchor: ArrayLike = ...,
        anchor_b: Optional[ArrayLike] = ...,
        axis: ArrayLike = ...,
        axis_2: Optional[ArrayLike] = ...,
        length: Optional[float] = ...,
        lead: Optional[float] = ...,
        lower: Optional[float] = ...,
        upper: Optional[float] = ...,
        restitution: float = ...,
        motor: Optional[JointMotor] = ...,
        servo: Optional[JointServo] = ...,
        spring: Optional[JointSpring] = ...,
        damping: float = ...,
        friction: float = ...,
        rotor_inertia: float = ...,
        cone: Optional[float] = ...,
        axes: Sequence[JointAxis] = ...,
        break_force: float = ...,
        break_torque: float = ...,
        collide: bool = ...,
        first: JointId = ...,
        second: JointId = ...,
        first_axis: int = ...,
        second_axis: int = ...,
        ratio: float = ...,
    ) -> None: ...
    @property
    def kind(self) -> JointKind:
        """What it keeps."""
    @property
    def a(self) -> BodyId:
        """First body."""
    @property
    def b(self) -> Optional[BodyId]:
        """Second body; None = the world itself."""
    @property
    def anchor(self) -> Floats:
        """Where they are joined, of distances and ropes the point of A [m, W]."""
    @property
    def anchor_b(self) -> Optional[Floats]:
        """Of distances and ropes: the point of B or the world [m, W]."""
    @property
    def axis(self) -> Floats:
        """Of any length above 0 [W]; of planar joints the normal."""
    @property
    def axis_2(self) -> Optional[Floats]:
        """Of universal, planar, generic and ball joints: not along axis [W]."""
    @property
    def length(self) -> Optional[float]:
        """Of distances and ropes [m], > 0; otherwise the distance at the beginning."""
    @property
    def lead(self) -> Optional[float]:
        """Of screws: displacement per turn [m]."""
    @property
    def lower(self) -> Optional[float]:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def upper(self) -> Optional[float]:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def restitution(self) -> float:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def motor(self) -> Optional[JointMotor]:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def servo(self) -> Optional[JointServo]:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def spring(self) -> Optional[JointSpring]:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def damping(self) -> float:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def friction(self) -> float:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def rotor_inertia(self) -> float:
        """Of hinges, sliders and screws, as in JointAxis."""
    @property
    def cone(self) -> Optional[float]:
        """Of balls: largest angle between the axes of A and B [rad], 0 to π."""
    @property
    def axes(self) -> tuple[JointAxis, ...]:
        """What acts along the free axes of other joints; of generic ones which are free."""
    @property
    def break_force(self) -> float:
        """Above which the joint breaks [N], > 0; of couplings along a displacement of the second."""
    @property
    def break_torque(self) -> float:
        """Above which it breaks [N·m], > 0; of couplings about an angle of the second."""
    @property
    def collide(self) -> bool:
        """Whether the two bodies may touch each other."""
    @property
    def first(self) -> JointId:
        """Of gears, racks and mimics: a joint."""
    @property
    def second(self) -> JointId:
        """The joint that follows it."""
    @property
    def first_axis(self) -> int:
        """Which free axis of the first."""
    @property
    def second_axis(self) -> int:
        """Which free axis of the second."""
    @property
    def ratio(self) -> float:
        """Of gears: opposite turns per turn; of racks [m/rad] and mimics: position per position."""
    infinite: float

class JointInfo(_Record):
    """A joint as it was after the last step."""

    def __init__(
        self,
        kind: Union[JointKind, str],
        a: BodyId,
        b: Optional[BodyId],
        anchor_a: ArrayLike,
        anchor_b: ArrayLike,
        axis: ArrayLike,
        position: float,
        speed: float,
        error: float,
        impulse: ArrayLike,
        angular_impulse: ArrayLike,
        force: ArrayLike,
        torque: ArrayLike,
        positions: Sequence[float],
        speeds: Sequence[float],
        redundant: int,
    ) -> None: ...
    @property
    def kind(self) -> JointKind:
        """What it keeps."""
    @property
    def a(self) -> BodyId:
        """First body; of gears, racks and mimics that of the first joint."""
    @property
    def b(self) -> Optional[BodyId]:
        """Second body, None = the world; of gears, racks and mimics the second joint's first."""
    @property
    def anchor_a(self) -> Floats:
        """The point of A [m, W]."""
    @property
    def anchor_b(self) -> Floats:
        """The point of B or of the world [m, W]."""
    @property
    def axis(self) -> Floats:
        """That of B: unit, W."""
    @property
    def position(self) -> float:
        """Of the first free axis; of distances and ropes their length [rad or m]."""
    @property
    def speed(self) -> float:
        """Its rate [rad/s or m/s]."""
    @property
    def error(self) -> float:
        """How far the joint is from what it keeps [m or rad]."""
    @property
    def impulse(self) -> Floats:
        """That A received at its point in the step [N·s, W]."""
    @property
    def angular_impulse(self) -> Floats:
        """That A received besides [N·m·s, W]."""
    @property
    def force(self) -> Floats:
        """The impulse divided by the time step [N, W]."""
    @property
    def torque(self) -> Floats:
        """The angular impulse divided by the time step [N·m, W]."""
    @property
    def positions(self) -> tuple[float, ...]:
        """Of the free axes [rad or m]; angles count on over turns."""
    @property
    def speeds(self) -> tuple[float, ...]:
        """Their rates [rad/s or m/s]."""
    @property
    def redundant(self) -> int:
        """How many of its conditions followed from those of others in the last step."""

class Ray(_Record):
    """A half line, or a line with an end."""

    def __init__(self, origin: ArrayLike = ..., direction: ArrayLike = ..., reach: float = ...) -> None: ...
    @property
    def origin(self) -> Floats:
        """[m, W]"""
    @property
    def direction(self) -> Floats:
        """[W], of any length but zero."""
    @property
    def reach(self) -> float:
        """Farthest distance of a hit [m], ≥ 0."""

class SurfaceHit(_Record):
    """Where a ray first meets a shape; one that begins inside has the distance 0."""

    def __init__(
        self,
        distance: float = ...,
        point: ArrayLike = ...,
        normal: ArrayLike = ...,
        part: int = ...,
    ) -> None: ...
    @property
    def distance(self) -> float:
        """From the origin of the ray [m]."""
    @property
    def point(self) -> Floats:
        """[m, W]"""
    @property
    def normal(self) -> Floats:
        """Of the surface: unit, outward, W."""
    @property
    def part(self) -> int:
        """Index in Compound.parts."""

class ShapeHit(_Record):
    """Where a shape that moves without turning first touches another; those that touch at the beginning have the
    distance 0."""

    def __init__(
        self,
        distance: float = ...,
        point: ArrayLike = ...,
        normal: ArrayLike = ...,
        moving_part: int = ...,
        part: int = ...,
    ) -> None: ...
    @property
    def distance(self) -> float:
        """That the moving shape goes until then [m]."""
    @property
    def point(self) -> Floats:
        """On the other shape [m, W]; one of many where faces or edges touch."""
    @property
    def normal(self) -> Floats:
        """Unit, from the other shape to the moving one, W."""
    @property
    def moving_part(self) -> int:
        """Of the moving shape."""
    @property
    def part(self) -> int:
        """Of the other shape."""

class RayHit(SurfaceHit):
    """A body that a ray hits."""

    def __init__(
        self,
        distance: float = ...,
        point: ArrayLike = ...,
        normal: ArrayLike = ...,
        part: int = ...,
        body: BodyId = ...,
    ) -> None: ...
    @property
    def body(self) -> BodyId:
        """Which one."""

class BodyHit(ShapeHit):
    """A body that a moving shape hits."""

    def __init__(
        self,
        distance: float = ...,
        point: ArrayLike = ...,
        normal: ArrayLike = ...,
        moving_part: int = ...,
        part: int = ...,
        body: BodyId = ...,
    ) -> None: ...
    @property
    def body(self) -> BodyId:
        """Which one."""

class ClosestPoints(_Record):
    """The points in which two shapes are closest, or overlap deepest."""

    def __init__(
        self,
        distance: float = ...,
        on_a: ArrayLike = ...,
        on_b: ArrayLike = ...,
        normal: ArrayLike = ...,
        part_a: int = ...,
        part_b: int = ...,
    ) -> None: ...
    @property
    def distance(self) -> float:
        """Along the normal [m]; negative = overlap."""
    @property
    def on_a(self) -> Floats:
        """On the surface of A [m, W]."""
    @property
    def on_b(self) -> Floats:
        """On the surface of B [m, W]."""
    @property
    def normal(self) -> Floats:
        """Unit, from B to A, W."""
    @property
    def part_a(self) -> int:
        """Of A."""
    @property
    def part_b(self) -> int:
        """Of B."""

class ShapeContact(_Record):
    """One point in which two shapes touch, as a step of the world finds it."""

    def __init__(self, point: ArrayLike, normal: ArrayLike, distance: float, part_a: int, part_b: int) -> None: ...
    @property
    def point(self) -> Floats:
        """Halfway between the surfaces [m, W]."""
    @property
    def normal(self) -> Floats:
        """Unit, from B to A, W."""
    @property
    def distance(self) -> float:
        """Along the normal [m]; negative = overlap."""
    @property
    def part_a(self) -> int:
        """Of A."""
    @property
    def part_b(self) -> int:
        """Of B."""

class Overlap(_Record):
    """A part of a body that overlaps a shape."""

    def __init__(self, body: BodyId = ..., part: int = ...) -> None: ...
    @property
    def body(self) -> BodyId:
        """Which one."""
    @property
    def part(self) -> int:
        """Of the body."""

class NearBody(_Record):
    """A body near a shape."""

    def __init__(self, body: BodyId = ..., closest: ClosestPoints = ...) -> None: ...
    @property
    def body(self) -> BodyId:
        """Which one."""
    @property
    def closest(self) -> ClosestPoints:
        """A is the shape, B the body."""

class GroupId:
    """The index of a group of bodies of a world."""

    def __init__(self, index: int) -> None: ...
    @property
    def index(self) -> int: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Sensed(_Record):
    """A body that a sensor holds."""

    def __init__(self, sensor: BodyId = ..., body: BodyId = ...) -> None: ...
    @property
    def sensor(self) -> BodyId:
        """A body that is a sensor."""
    @property
    def body(self) -> BodyId:
        """One that overlaps it and is no sensor."""

class ConstantMotion(_Record):
    """Moves and turns at constant rates, like a roller or a piston."""

    def __init__(self, velocity: ArrayLike = ..., spin: ArrayLike = ...) -> None: ...
    @property
    def velocity(self) -> Floats:
        """[m/s, W]"""
    @property
    def spin(self) -> Floats:
        """[rad/s, W]"""

class SineMotion(_Record):
    """Swings: x(t) = amplitude·(sin(2π·frequency·t + phase) - sin(phase)), so that it begins where the body is; with
    the phase π/2 it begins at rest."""

    def __init__(
        self,
        amplitude: ArrayLike = ...,
        turn: ArrayLike = ...,
        frequency: float = ...,
        phase: float = ...,
    ) -> None: ...
    @property
    def amplitude(self) -> Floats:
        """Of the displacement [m, W]."""
    @property
    def turn(self) -> Floats:
        """Of the rotation vector [rad, W]."""
    @property
    def frequency(self) -> float:
        """[Hz], > 0"""
    @property
    def phase(self) -> float:
        """[rad]"""

class TableMotion(_Record):
    """Goes through given places at given times, on cubic curves with continuous velocity. Displacements and turns count
    from the first entry."""

    def __init__(
        self,
        times: ArrayLike,
        displacements: ArrayLike = ...,
        turns: ArrayLike = ...,
        velocities: ArrayLike = ...,
        end: Union[TableEnd, str] = ...,
    ) -> None: ...
    @property
    def times(self) -> Floats:
        """From the beginning of the motion, ascending, at least two [s], shape (n,)."""
    @property
    def displacements(self) -> Floats:
        """[m, W], shape (n, 3), or none."""
    @property
    def turns(self) -> Floats:
        """Rotation vectors [rad, W], shape (n, 3), or none."""
    @property
    def velocities(self) -> Floats:
        """[m/s, W], shape (n, 3); or none: then those of a smooth curve, at rest at both ends unless the table
        repeats."""
    @property
    def end(self) -> TableEnd:
        """What comes after the last time."""

class DetectionSettings(_Record):
    """Broad and narrow phase."""

    def __init__(self, contact_margin: float = ...) -> None: ...
    @property
    def contact_margin(self) -> float:
        """contacts are reported up to this distance before touching; 0 without penetration_threshold = a sixteenth of
        the overlap allowed [m]"""

class CorrectionSettings(_Record):
    """Penetration correction."""

    def __init__(
        self,
        correction: Union[CorrectionKind, str] = ...,
        penetration_threshold: float = ...,
        allowed_overlap: float = ...,
    ) -> None: ...
    @property
    def correction(self) -> CorrectionKind:
        """algorithm of the penetration correction"""
    @property
    def penetration_threshold(self) -> float:
        """overlap above which a contact is corrected; 0 = allowed_overlap [m]"""
    @property
    def allowed_overlap(self) -> float:
        """the same as part of the smaller body's smallest extent, where penetration_threshold is 0"""

class ResolutionSettings(_Record):
    """Contact resolution and shock propagation."""

    def __init__(
        self,
        resolution: Union[ResolutionKind, str] = ...,
        resolution_threshold: float = ...,
        restitution_threshold: float = ...,
        restitution_law: Union[RestitutionLaw, str] = ...,
        restitution_speed: Union[RestitutionSpeed, str] = ...,
        impacts: Union[Impacts, str] = ...,
        iterations: float = ...,
        tolerance: float = ...,
        pulled_tolerance: float = ...,
        shock_propagation: bool = ...,
    ) -> None: ...
    @property
    def resolution(self) -> ResolutionKind:
        """algorithm of the contact resolution"""
    @property
    def resolution_threshold(self) -> float:
        """closing speed above which a contact is resolved (3.4.3) [m/s]"""
    @property
    def restitution_threshold(self) -> float:
        """closing speed below which restitution is zero (3.8.1) [m/s]"""
    @property
    def restitution_law(self) -> RestitutionLaw:
        """restitution as a ratio of speeds (the thesis) or, never gaining energy, of works"""
    @property
    def restitution_speed(self) -> RestitutionSpeed:
        """restitution takes the closing speed with the step's forces (the thesis) or that at the touching"""
    @property
    def impacts(self) -> Impacts:
        """impacts in touching chains: as the resolution does, in sequence or all at once"""
    @property
    def iterations(self) -> float:
        """most resolutions per contact of 'impulse_queue' and 'arbitrary_order', or sweeps over a batch of the others
        (where it rests, three times as many of 'accelerated_sweeps'); 0 = no limit"""
    @property
    def tolerance(self) -> float:
        """'accelerated_sweeps' goes on until about so much is left to change, as a part of how a batch's contacts
        move"""
    @property
    def pulled_tolerance(self) -> float:
        """'tolerance' where forces of users, springs or joints act, if it is less"""
    @property
    def shock_propagation(self) -> bool:
        """shock propagation of 'impulse_queue' when iterations were not enough (Algorithm 10)"""

class SleepSettings(_Record):
    """Sleeping and gravity damping."""

    def __init__(self, sleeping: bool = ..., sleep_threshold: float = ..., damping: float = ...) -> None: ...
    @property
    def sleeping(self) -> bool:
        """bodies at rest fall asleep"""
    @property
    def sleep_threshold(self) -> float:
        """a body whose averaged motion is below this sleeps (3.2.5); 'accelerated_sweeps' wakes what is pushed to more
        [m/s]"""
    @property
    def damping(self) -> float:
        """part of gravity taken from bodies slower than ten times sleep_threshold; 0 = off (Algorithm 12); 'accelerated_sweeps' takes nothing where other forces act as well and from what moves evenly"""

class IntegrationSettings(_Record):
    """Motion of bodies."""

    def __init__(self, exact_flight: bool = ..., most_parts: int = ...) -> None: ...
    @property
    def exact_flight(self) -> bool:
        """smooth motion follows the mean of a step's velocities, so that free bodies keep to the parabola"""
    @property
    def most_parts(self) -> int:
        """a step is divided into so many parts at most (the next lower power of two) where what touches moves far; 1 = never"""

class ParallelSettings(_Record):
    """Threads; results do not depend on them."""

    def __init__(self, threads: int = ..., always_helped: bool = ...) -> None: ...
    @property
    def threads(self) -> int:
        """threads of a step; results do not depend on it"""
    @property
    def always_helped(self) -> bool:
        """all threads take part in every stage; without it where their processors are free and it is faster"""

class DiagnosticsSettings(_Record):
    """What a step measures besides."""

    def __init__(self, diagnostics: bool = ...) -> None: ...
    @property
    def diagnostics(self) -> bool:
        """every step measures momentum, energy accounts and residuals"""

class Settings(_Record):
    """All settings of a world, one record per stage."""

    def __init__(
        self,
        steps_per_second: float = ...,
        detection: DetectionSettings = ...,
        correction: CorrectionSettings = ...,
        resolution: ResolutionSettings = ...,
        sleep: SleepSettings = ...,
        integration: IntegrationSettings = ...,
        parallel: ParallelSettings = ...,
        diagnostics: DiagnosticsSettings = ...,
        steps_by_size: bool = ...,
    ) -> None: ...
    @property
    def steps_per_second(self) -> float:
        """Time steps per simulated second, 1e-3 to 1e6 [1/s]."""
    @property
    def steps_by_size(self) -> bool:
        """Whether steps_per_second is for bodies of 0.12 m under 10 m/s² and others get a power of two times as many when the world takes its first step."""
    @property
    def detection(self) -> DetectionSettings:
        """Broad and narrow phase."""
    @property
    def correction(self) -> CorrectionSettings:
        """Penetration correction."""
    @property
    def resolution(self) -> ResolutionSettings:
        """Contact resolution and shock propagation."""
    @property
    def sleep(self) -> SleepSettings:
        """Sleeping and gravity damping."""
    @property
    def integration(self) -> IntegrationSettings:
        """Motion of free bodies."""
    @property
    def parallel(self) -> ParallelSettings:
        """Threads."""
    @property
    def diagnostics(self) -> DiagnosticsSettings:
        """What a step measures besides."""
    @property
    def time_step(self) -> float:
        """The length of a time step [s]."""
    @staticmethod
    def preset(preset: Union[Preset, str], steps_per_second: float = ..., gravity: float = ...) -> Settings:
        """A preset, its speed thresholds scaled to the time step and to gravity [m/s²]. Raises InputError."""

class SettingField:
    """One field of Settings, by name."""

    @property
    def name(self) -> str:
        """Unique, as in scene files."""
    @property
    def stage(self) -> str:
        """What it belongs to."""
    @property
    def unit(self) -> str:
        """SI unit, or empty."""
    @property
    def meaning(self) -> str:
        """One sentence."""
    @property
    def minimum(self) -> float:
        """Smallest allowed number."""
    @property
    def maximum(self) -> float:
        """Largest allowed number."""
    @property
    def choices(self) -> tuple[str, ...]:
        """Allowed names."""
    def get(self, settings: Settings) -> SettingValue:
        """Its value."""

class Diagnostics(_Record):
    """Momentum, energy and contact laws of a step, with the setting diagnostics only."""

    def __init__(
        self,
        momentum: ArrayLike = ...,
        angular_momentum: ArrayLike = ...,
        fixed_impulse: ArrayLike = ...,
        fixed_angular_impulse: ArrayLike = ...,
        force_impulse: ArrayLike = ...,
        force_angular_impulse: ArrayLike = ...,
        momentum_error: float = ...,
        angular_momentum_error: float = ...,
        energy: float = ...,
        energy_flight: float = ...,
        energy_forces: float = ...,
        energy_damping: float = ...,
        energy_friction: float = ...,
        energy_restitution: float = ...,
        energy_joints: float = ...,
        energy_correction: float = ...,
        energy_drives: float = ...,
        energy_sleep: float = ...,
        energy_error: float = ...,
        signorini: float = ...,
        de_saxce: float = ...,
        dissipation: float = ...,
    ) -> None: ...
    @property
    def momentum(self) -> Floats:
        """Of all dynamic bodies at the end [N·s, W]."""
    @property
    def angular_momentum(self) -> Floats:
        """Likewise, about the origin [N·m·s, W]."""
    @property
    def fixed_impulse(self) -> Floats:
        """From fixed bodies and the world [N·s, W]."""
    @property
    def fixed_angular_impulse(self) -> Floats:
        """Likewise, about the origin [N·m·s, W]."""
    @property
    def force_impulse(self) -> Floats:
        """From gravity, applied forces and springs [N·s, W]."""
    @property
    def force_angular_impulse(self) -> Floats:
        """Likewise, about the origin [N·m·s, W]."""
    @property
    def momentum_error(self) -> float:
        """Change that neither explains [N·s]."""
    @property
    def angular_momentum_error(self) -> float:
        """Likewise [N·m·s]."""
    @property
    def energy(self) -> float:
        """Kinetic and potential energy at the end [J]."""
    @property
    def energy_flight(self) -> float:
        """Error of the motion under gravity [J]."""
    @property
    def energy_forces(self) -> float:
        """Work of applied forces and springs [J]."""
    @property
    def energy_damping(self) -> float:
        """Of the gravity damping [J]."""
    @property
    def energy_friction(self) -> float:
        """Work of friction [J]."""
    @property
    def energy_restitution(self) -> float:
        """Work of the contacts along their normals [J]."""
    @property
    def energy_joints(self) -> float:
        """Work of joints, motors included [J]."""
    @property
    def energy_correction(self) -> float:
        """Potential energy by the penetration correction [J]."""
    @property
    def energy_drives(self) -> float:
        """Of bodies, a frame or a gravity that follow a law [J]."""
    @property
    def energy_sleep(self) -> float:
        """Of bodies that fell asleep [J]."""
    @property
    def energy_error(self) -> float:
        """What no account explains [J]."""
    @property
    def signorini(self) -> float:
        """Largest residual of Signorini's law [J]."""
    @property
    def de_saxce(self) -> float:
        """Largest residual of the complementarity of the cones [J]."""
    @property
    def dissipation(self) -> float:
        """Largest residual of the law of dissipation [J]."""

class DiagnosticsField:
    """One number of Diagnostics, by name."""

    @property
    def name(self) -> str:
        """As in recordings."""
    @property
    def unit(self) -> str:
        """SI unit."""
    @property
    def fold(self) -> Fold:
        """How several steps become one number."""
    def of(self, diagnostics: Diagnostics) -> float:
        """Its value."""

class Statistics(_Record):
    """Counters of one time step, or sums and extremes over several."""

    def __init__(
        self,
        stage_ms: Sequence[float] = ...,
        contacts: int = ...,
        penetrating_contacts: int = ...,
        corrected_contacts: int = ...,
        uncorrected_contacts: int = ...,
        displaced_bodies: int = ...,
        global_iterations: int = ...,
        shock_iterations: int = ...,
        shock_batches: int = ...,
        batches: int = ...,
        largest_batch: int = ...,
        asleep: int = ...,
        woken: int = ...,
        largest_overlap: float = ...,
        mean_overlap: float = ...,
        diagnostics: Diagnostics = ...,
    ) -> None: ...
    @property
    def stage_ms(self) -> tuple[float, ...]:
        """Wall time per stage [ms]."""
    @property
    def contacts(self) -> int:
        """Contact points."""
    @property
    def penetrating_contacts(self) -> int:
        """Deeper than the penetration threshold."""
    @property
    def corrected_contacts(self) -> int:
        """Of these, brought back within the threshold."""
    @property
    def uncorrected_contacts(self) -> int:
        """Of these, left."""
    @property
    def displaced_bodies(self) -> int:
        """Moves of bodies by the correction."""
    @property
    def global_iterations(self) -> int:
        """Contacts resolved by the global resolution."""
    @property
    def shock_iterations(self) -> int:
        """Contacts resolved by the shock propagation."""
    @property
    def shock_batches(self) -> int:
        """Batches that needed the shock propagation."""
    @property
    def batches(self) -> int:
        """Groups of connected bodies."""
    @property
    def largest_batch(self) -> int:
        """Contacts of the largest batch."""
    @property
    def asleep(self) -> int:
        """Bodies asleep at the end."""
    @property
    def woken(self) -> int:
        """Bodies woken."""
    @property
    def largest_overlap(self) -> float:
        """After the correction [m]."""
    @property
    def mean_overlap(self) -> float:
        """Over the overlapping contacts, after the correction [m]."""
    @property
    def diagnostics(self) -> Diagnostics:
        """Zero without the setting."""
    def __add__(self, next: Statistics) -> Statistics:
        """Both steps together."""

class BatchInfo(_Record):
    """A group of bodies connected by contacts, fixed bodies being barriers."""

    def __init__(self, bodies: Sequence[BodyId] = ..., contacts: int = ...) -> None: ...
    @property
    def bodies(self) -> tuple[BodyId, ...]:
        """In ascending order of id."""
    @property
    def contacts(self) -> int:
        """Contact points between them."""

class BodyTrace(_Record):
    """What the last step did with a body, for viewers."""

    def __init__(
        self,
        bounds_lower: ArrayLike = ...,
        bounds_upper: ArrayLike = ...,
        level: int = ...,
        correction: ArrayLike = ...,
        shock_stage: int = ...,
    ) -> None: ...
    @property
    def bounds_lower(self) -> Floats:
        """As the broad phase saw them [m, W]."""
    @property
    def bounds_upper(self) -> Floats:
        """[m, W]"""
    @property
    def level(self) -> int:
        """In the hierarchy of the broad phase; -1 = outside it."""
    @property
    def correction(self) -> Floats:
        """Displacement by the correction [m, W]; needs tracing."""
    @property
    def shock_stage(self) -> int:
        """Subset of the shock propagation; -1 = none."""

class FaultInfo(_Record):
    """A body that left the finite numbers was fixed where it last was finite."""

    def __init__(self, body: BodyId = ..., step: int = ..., what: str = ...) -> None: ...
    @property
    def body(self) -> BodyId:
        """Which one."""
    @property
    def step(self) -> int:
        """Number of the time step, from 1."""
    @property
    def what(self) -> str:
        """Its numbers as text."""

class SceneBody(_Record):
    """A body of a scene; its index in Scene.bodies is its number in recordings."""

    def __init__(
        self,
        shape: Shape,
        material: str,
        name: str = ...,
        mass: Optional[float] = ...,
        centre_of_mass: Optional[ArrayLike] = ...,
        inertia: Optional[ArrayLike] = ...,
        position: ArrayLike = ...,
        orientation: ArrayLike = ...,
        linear_velocity: ArrayLike = ...,
        angular_velocity: ArrayLike = ...,
        fixed: bool = ...,
        asleep: bool = ...,
        groups: Sequence[str] = ...,
        sensor: bool = ...,
        gravity_factor: float = ...,
        linear_damping: float = ...,
        angular_damping: float = ...,
        user_data: int = ...,
        motion: Optional[Motion] = ...,
        pivot: ArrayLike = ...,
        surface_velocity: ArrayLike = ...,
        locked: Sequence[Union[JointAlong, str]] = ...,
    ) -> None: ...
    @property
    def shape(self) -> Shape:
        """In its own frame."""
    @property
    def material(self) -> str:
        """Name of one of Scene.materials."""
    @property
    def name(self) -> str:
        """Unique if not empty."""
    @property
    def mass(self) -> Optional[float]:
        """[kg]"""
    @property
    def centre_of_mass(self) -> Optional[Floats]:
        """As that of BodyDescription."""
    @property
    def inertia(self) -> Optional[Floats]:
        """As that of BodyDescription."""
    @property
    def position(self) -> Floats:
        """Of the shape's frame [m, W]."""
    @property
    def orientation(self) -> Floats:
        """Shape's frame to W: a quaternion (w, x, y, z)."""
    @property
    def linear_velocity(self) -> Floats:
        """[m/s, W]"""
    @property
    def angular_velocity(self) -> Floats:
        """[rad/s, W]"""
    @property
    def fixed(self) -> bool:
        """Never moves."""
    @property
    def asleep(self) -> bool:
        """Begins asleep."""
    @property
    def groups(self) -> tuple[str, ...]:
        """Names of SceneFilters.groups."""
    @property
    def sensor(self) -> bool:
        """Touches nobody; World.sensed() and events say who is inside."""
    @property
    def gravity_factor(self) -> float:
        """Of the global accelerations that it feels, -1e3 to 1e3; 0 = weightless."""
    @property
    def linear_damping(self) -> float:
        """Rate at which the linear velocity decays [1/s], 0 to 1e6."""
    @property
    def angular_damping(self) -> float:
        """Rate at which the angular velocity decays [1/s], 0 to 1e6."""
    @property
    def user_data(self) -> int:
        """A number of the user's own, 0 to 2⁶⁴ - 1."""
    @property
    def motion(self) -> Optional[Motion]:
        """Of a fixed body: the law by which it moves."""
    @property
    def pivot(self) -> Floats:
        """Of the motion [m, frame of the shape]."""
    @property
    def surface_velocity(self) -> Floats:
        """Of a fixed body: with which its surface runs over it [m/s, frame of the shape]."""
    @property
    def locked(self) -> tuple[JointAlong, ...]:
        """Axes of W along and about which a dynamic body does not move."""

class SceneException(_Record):
    """An exception of two bodies of a scene from what their groups say."""

    def __init__(self, a: int, b: int, touch: Union[Touch, str] = ...) -> None: ...
    @property
    def a(self) -> int:
        """Index in Scene.bodies."""
    @property
    def b(self) -> int:
        """Index in Scene.bodies."""
    @property
    def touch(self) -> Touch:
        """Whether they do."""

class SceneFilters(_Record):
    """Which bodies of a scene touch each other."""

    def __init__(
        self,
        groups: Sequence[str] = ...,
        apart: Sequence[tuple[str, str]] = ...,
        exceptions: Sequence[SceneException] = ...,
    ) -> None: ...
    @property
    def groups(self) -> tuple[str, ...]:
        """Unique names, at most most_groups."""
    @property
    def apart(self) -> tuple[tuple[str, str], ...]:
        """Pairs of groups that never touch."""
    @property
    def exceptions(self) -> tuple[SceneException, ...]:
        """Of pairs of bodies."""
    def is_empty(self) -> bool:
        """Whether all bodies touch."""

class SceneJoint(_Record):
    """A joint of a scene."""

    def __init__(
        self,
        a: int,
        b: Optional[int],
        joint: JointDescription,
        first: Optional[int] = ...,
        second: Optional[int] = ...,
    ) -> None: ...
    @property
    def a(self) -> int:
        """Index in Scene.bodies."""
    @property
    def b(self) -> Optional[int]:
        """Index in Scene.bodies; None = the world."""
    @property
    def joint(self) -> JointDescription:
        """All else, as the bodies stand at the beginning."""
    @property
    def first(self) -> Optional[int]:
        """Of gears, racks and mimics: index of an earlier one in Scene.joints."""
    @property
    def second(self) -> Optional[int]:
        """Likewise: the joint that follows it."""

class SceneDrive(_Record):
    """Lets something follow a function of time: start plus the displacement of a law of motion."""

    def __init__(
        self,
        what: Union[DriveOf, str],
        target: int,
        axis: int = ...,
        start: ArrayLike = ...,
        law: Union[ConstantMotion, SineMotion, TableMotion] = ...,
    ) -> None: ...
    @property
    def what(self) -> DriveOf:
        """Of the target: position, speed, force or torque."""
    @property
    def target(self) -> int:
        """Index in Scene.joints or, of forces and torques, in Scene.bodies."""
    @property
    def axis(self) -> int:
        """Which free axis of the joint."""
    @property
    def start(self) -> Floats:
        """Its value at the beginning; of joints x counts."""
    @property
    def law(self) -> Union[ConstantMotion, SineMotion, TableMotion]:
        """How it changes, in its unit in place of metres; without turns."""

class SceneSpring(_Record):
    """A spring of a scene."""

    def __init__(
        self,
        a: int,
        b: Optional[int] = ...,
        anchor_a: ArrayLike = ...,
        anchor_b: ArrayLike = ...,
        stiffness: float = ...,
        damping: float = ...,
        rest_length: float = ...,
    ) -> None: ...
    @property
    def a(self) -> int:
        """Index of the body."""
    @property
    def b(self) -> Optional[int]:
        """Index of the second body; None = a point of the world."""
    @property
    def anchor_a(self) -> Floats:
        """[m, frame of A]"""
    @property
    def anchor_b(self) -> Floats:
        """[m, frame of B or W]"""
    @property
    def stiffness(self) -> float:
        """[N/m]"""
    @property
    def damping(self) -> float:
        """[N·s/m]"""
    @property
    def rest_length(self) -> float:
        """[m]"""

class SetGravity(_Record):
    """An event sets gravity."""

    def __init__(self, gravity: ArrayLike) -> None: ...
    @property
    def gravity(self) -> Floats:
        """[m/s², W]"""

class SetVelocity(_Record):
    """An event sets a body's velocity."""

    def __init__(self, body: int, velocity: ArrayLike) -> None: ...
    @property
    def body(self) -> int:
        """Index in Scene.bodies."""
    @property
    def velocity(self) -> Floats:
        """Linear [m/s, W]."""

class GiveImpulse(_Record):
    """An event gives a body an impulse at its centre of mass."""

    def __init__(self, body: int, impulse: ArrayLike) -> None: ...
    @property
    def body(self) -> int:
        """Index in Scene.bodies."""
    @property
    def impulse(self) -> Floats:
        """[N·s, W]"""

class SetForce(_Record):
    """An event sets a body's constant force."""

    def __init__(self, body: int, force: ArrayLike) -> None: ...
    @property
    def body(self) -> int:
        """Index in Scene.bodies."""
    @property
    def force(self) -> Floats:
        """From then on, at the centre of mass [N, W]."""

class SetTorque(_Record):
    """An event sets a body's constant torque."""

    def __init__(self, body: int, torque: ArrayLike) -> None: ...
    @property
    def body(self) -> int:
        """Index in Scene.bodies."""
    @property
    def torque(self) -> Floats:
        """From then on [N·m, W]."""

class RemoveBody(_Record):
    """An event takes a body out of the world."""

    def __init__(self, body: int) -> None: ...
    @property
    def body(self) -> int:
        """Index in Scene.bodies."""

class SceneEvent(_Record):
    """Happens at the first time step that begins at or after its time."""

    def __init__(self, time: float, action: EventAction) -> None: ...
    @property
    def time(self) -> float:
        """[s], ≥ 0"""
    @property
    def action(self) -> EventAction:
        """What it does."""

class Scene(_Record):
    """Everything of a scene file, in its order."""

    def __init__(
        self,
        name: str,
        duration: float,
        gravity: ArrayLike = ...,
        gravity_law: Optional[Motion] = ...,
        events: Sequence[SceneEvent] = ...,
        materials: Sequence[Material] = ...,
        default_pair: PairProperties = ...,
        pairs: Union[Mapping[tuple[str, str], PairProperties], Sequence[tuple[tuple[str, str], PairProperties]]] = ...,
        pair_laws: Union[Mapping[tuple[str, str], PairLaw], Sequence[tuple[tuple[str, str], PairLaw]]] = ...,
        filters: SceneFilters = ...,
        frame_motion: Optional[Motion] = ...,
        bodies: Sequence[SceneBody] = ...,
        springs: Sequence[SceneSpring] = ...,
        joints: Sequence[SceneJoint] = ...,
        drives: Sequence[SceneDrive] = ...,
        preset: Optional[Union[Preset, str]] = ...,
        settings: Union[Mapping[str, SettingValue], Sequence[tuple[str, SettingValue]]] = ...,
    ) -> None: ...
    @property
    def name(self) -> str:
        """For messages and recordings."""
    @property
    def duration(self) -> float:
        """[s], > 0"""
    @property
    def gravity(self) -> Floats:
        """[m/s², W]"""
    @property
    def gravity_law(self) -> Optional[Motion]:
        """How it changes, as in World.set_gravity; None = it stays."""
    @property
    def events(self) -> tuple[SceneEvent, ...]:
        """What happens at times."""
    @property
    def materials(self) -> tuple[Material, ...]:
        """What bodies are made of."""
    @property
    def default_pair(self) -> PairProperties:
        """Of materials that have no pair of their own."""
    @property
    def pairs(self) -> tuple[tuple[tuple[str, str], PairProperties], ...]:
        """Names of two materials, and what holds where they touch."""
    @property
    def pair_laws(self) -> tuple[tuple[tuple[str, str], PairLaw], ...]:
        """Names of two of them, and what depends on speed there."""
    @property
    def filters(self) -> SceneFilters:
        """Which bodies touch each other."""
    @property
    def frame_motion(self) -> Optional[Motion]:
        """The law by which the frame of the world moves; None = it rests."""
    @property
    def bodies(self) -> tuple[SceneBody, ...]:
        """In the order of their numbers."""
    @property
    def springs(self) -> tuple[SceneSpring, ...]:
        """Between bodies, or a body and the world."""
    @property
    def joints(self) -> tuple[SceneJoint, ...]:
        """Between bodies, or a body and the world."""
    @property
    def drives(self) -> tuple[SceneDrive, ...]:
        """What follows functions of time."""
    @property
    def preset(self) -> Optional[Preset]:
        """Where the settings begin; None = performance."""
    @property
    def settings(self) -> tuple[tuple[str, SettingValue], ...]:
        """Names and values of other settings than the preset's."""

class Scales(_Record):
    """What lengths, times and masses are multiplied by."""

    def __init__(self, length: float = ..., time: float = ..., mass: float = ...) -> None: ...
    @property
    def length(self) -> float:
        """> 0"""
    @property
    def time(self) -> float:
        """> 0"""
    @property
    def mass(self) -> float:
        """> 0"""

class SettingOverrides(_Record):
    """What overrides a scene's own settings."""

    def __init__(
        self,
        preset: Optional[Union[Preset, str]] = ...,
        steps_per_second: Optional[float] = ...,
        fields: Union[Mapping[str, object], Sequence[tuple[str, object]]] = ...,
    ) -> None: ...
    @property
    def preset(self) -> Optional[Preset]:
        """In place of the scene's."""
    @property
    def steps_per_second(self) -> Optional[float]:
        """In place of the preset's [1/s]."""
    @property
    def fields(self) -> tuple[tuple[str, str], ...]:
        """Names and values of settings; values read as text."""

class BuiltInScene:
    """A built-in scene, or a family of them."""

    @property
    def name(self) -> str:
        """As on the command line: 'stacks5', 'tower:N'."""
    @property
    def description(self) -> str:
        """One sentence."""
    @property
    def example(self) -> str:
        """A name that can be given: 'tower:10'."""

class RollbackState:
    """A world at one time, in memory only. Empty until World.keep()."""

    def __init__(self) -> None: ...

class Bodies:
    """The state of all bodies. Row i of an array is that of the body with index i; rows of removed bodies, whose
    kind is hole, mean nothing."""

    @property
    def kind(self) -> NDArray[np.uint8]:
        """Numbers of BodyKind, shape (slots,)."""
    @property
    def generation(self) -> NDArray[np.uint32]:
        """Of the slot, shape (slots,)."""
    @property
    def centre_of_mass(self) -> Floats:
        """[m, W], shape (slots, 3)."""
    @property
    def principal_axes_xyzw(self) -> Floats:
        """Of the principal inertia, B to W: quaternions in the order of memory (x, y, z, w), shape (slots, 4)."""
    @property
    def linear_velocity(self) -> Floats:
        """Of the centre of mass [m/s, W], shape (slots, 3)."""
    @property
    def angular_velocity(self) -> Floats:
        """[rad/s, W], shape (slots, 3)."""
    @property
    def mass(self) -> Floats:
        """[kg], shape (slots,); of fixed bodies what it were if they moved."""
    @property
    def asleep(self) -> NDArray[np.bool_]:
        """Whether it sleeps, shape (slots,)."""
    @property
    def slots(self) -> int:
        """Rows of every array."""
    @property
    def id(self) -> Structured:
        """A copy as an array of body_id_dtype, shape (slots,)."""
    def poses(self) -> tuple[Floats, Floats]:
        """Copies of the poses of the shapes' frames in W: positions [m], shape (slots, 3), and quaternions (w, x,
        y, z), shape (slots, 4)."""
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[BodyId]: ...
    def __contains__(self, id: BodyId) -> bool: ...

class World:
    """A simulated world: right-handed, SI units, world frame W unless named. One thread at a time may use it."""

    def __init__(self, settings: Optional[Settings] = ...) -> None:
        """settings: those of the preset performance if None. Raises InputError."""
    @overload
    def add_body(self, description: BodyDescription, /) -> BodyId:
        """Adds a body as described; position and orientation may stand for a pose. Raises InputError."""
    @overload
    def add_body(
        self, shape: Shape = ..., material: MaterialId = ..., mass: Optional[float] = ...,
        centre_of_mass: Optional[ArrayLike] = ..., inertia: Optional[ArrayLike] = ..., pose: Pose = ...,
        linear_velocity: ArrayLike = ..., angular_velocity: ArrayLike = ..., fixed: bool = ..., asleep: bool = ...,
        name: str = ..., groups: Sequence[GroupId] = ..., sensor: bool = ..., gravity_factor: float = ...,
        linear_damping: float = ..., angular_damping: float = ..., user_data: int = ...,
        motion: Optional[Motion] = ..., pivot: ArrayLike = ..., surface_velocity: ArrayLike = ...,
        locked: Sequence[Union[JointAlong, str]] = ..., *, position: ArrayLike = ..., orientation: ArrayLike = ...
    ) -> BodyId: ...
    def remove_body(self, id: BodyId) -> None:
        """Wakes the sleeping bodies that touched it; its springs and joints go with it. Raises StaleIdError."""
    @property
    def bodies(self) -> Bodies:
        """The state of all bodies in arrays."""
    @property
    def body_count(self) -> int:
        """Bodies in the world."""
    @property
    def layout_version(self) -> int:
        """Another number as soon as arrays of the bodies are to be taken anew."""
    @overload
    def add_material(self, description: Material, /) -> MaterialId:
        """Adds a material of a name and a density [kg/m³]. Raises InputError."""
    @overload
    def add_material(
        self, name: str, density: float
    ) -> MaterialId: ...
    @property
    def materials(self) -> tuple[Material, ...]:
        """All materials, in the order of their ids."""
    @overload
    def set_default_pair_properties(self, description: PairProperties, /) -> None:
        """Properties of pairs that have none of their own. Raises InputError."""
    @overload
    def set_default_pair_properties(
        self, 
        restitution: float = ..., static_friction: float = ..., kinetic_friction: float = ...,
        rolling_friction: float = ..., spinning_friction: float = ...
    ) -> None: ...
    @overload
    def set_pair_properties(self, a: MaterialId, b: MaterialId, description: PairProperties, /) -> None:
        """Properties where a touches b and b touches a. Raises InputError."""
    @overload
    def set_pair_properties(
        self, a: MaterialId, b: MaterialId, 
        restitution: float = ..., static_friction: float = ..., kinetic_friction: float = ...,
        rolling_friction: float = ..., spinning_friction: float = ...
    ) -> None: ...
    def pair_properties(self, a: MaterialId, b: MaterialId) -> PairProperties:
        """Raises InputError."""
    @overload
    def set_pair_law(self, a: MaterialId, b: MaterialId, description: PairLaw, /) -> None:
        """Lets properties where a touches b depend on the velocity there. Raises InputError."""
    @overload
    def set_pair_law(
        self, a: MaterialId, b: MaterialId, restitution: SpeedCurve = ..., friction: SpeedCurve = ...
    ) -> None: ...
    def pair_law(self, a: MaterialId, b: MaterialId) -> PairLaw:
        """Without curves unless it was set. Raises InputError."""
    @overload
    def add_spring(self, description: SpringDescription, /) -> SpringId:
        """Adds a spring. Raises InputError, StaleIdError."""
    @overload
    def add_spring(
        self, a: BodyId, anchor_a: ArrayLike = ..., b: Optional[BodyId] = ..., anchor_b: ArrayLike = ...,
        stiffness: float = ..., damping: float = ..., rest_length: float = ...
    ) -> SpringId: ...
    def remove_spring(self, id: SpringId) -> None:
        """Raises StaleIdError."""
    def set_spring_anchor(self, id: SpringId, anchor_b: ArrayLike) -> None:
        """Moves the second anchor [m, frame of B or W] and wakes its bodies. Raises StaleIdError, InputError."""
    @overload
    def add_joint(self, description: JointDescription, /) -> JointId:
        """Joins bodies as they stand now. Raises InputError, StaleIdError."""
    @overload
    def add_joint(
        self, kind: Union[JointKind, str], a: BodyId = ..., b: Optional[BodyId] = ..., anchor: ArrayLike =
        ..., anchor_b: Optional[ArrayLike] = ..., axis: ArrayLike = ..., axis_2: Optional[ArrayLike] = ...,
        length: Optional[float] = ..., lead: Optional[float] = ..., lower: Optional[float] = ..., upper:
        Optional[float] = ..., restitution: float = ..., motor: Optional[JointMotor] = ..., servo:
        Optional[JointServo] = ..., spring: Optional[JointSpring] = ..., damping: float = ..., friction: float
        = ..., rotor_inertia: float = ..., cone: Optional[float] = ..., axes: Sequence[JointAxis] = ...,
        break_force: float = ..., break_torque: float = ..., collide: bool = ..., first: JointId = ...,
        second: JointId = ..., first_axis: int = ..., second_axis: int = ..., ratio: float = ...
    ) -> JointId: ...
    def remove_joint(self, id: JointId) -> None:
        """Wakes its bodies. Raises StaleIdError."""
    def joints(self) -> list[JointId]:
        """Ids of all joints, in ascending order of index."""
    def joint(self, id: JointId) -> JointInfo:
        """As it was after the last step. Raises StaleIdError."""
    @overload
    def set_joint_motor(self, id: JointId, description: JointMotor, /) -> None:
        """Of hinges, sliders and screws; a limit of 0 switches it off. Raises InputError, StaleIdError."""
    @overload
    def set_joint_motor(
        self, id: JointId, speed: float = ..., limit: float = ...
    ) -> None: ...
    def set_joint_limits(self, id: JointId, lower: Optional[float], upper: Optional[float]) -> None:
        """Of hinges and screws [rad] and sliders [m]. Raises InputError, StaleIdError."""
    @overload
    def set_joint_servo(self, id: JointId, description: JointServo, /) -> None:
        """Of hinges, sliders and screws: what it drives to from now on. Raises InputError, StaleIdError."""
    @overload
    def set_joint_servo(
        self, id: JointId, position: float = ..., speed: float = ..., stiffness: float = ..., damping: float = ...,
        limit: float = ...
    ) -> None: ...
    def set_joint_axis(self, id: JointId, index: int, axis: JointAxis) -> None:
        """All that acts along a free axis from now on. Raises InputError, StaleIdError."""
    def __contains__(self, id: Union[BodyId, JointId]) -> bool: ...
    gravity: _Vector
    """[m/s², W]; a change wakes every body and ends a law. Raises InputError."""
    def set_gravity(self, gravity: ArrayLike, law: Optional[Motion] = ...) -> None:
        """Gravity now [m/s², W], and a law whose displacement, in m/s² in place of m, is added to it from now on; while
        it changes nobody falls asleep. Raises InputError."""
    @property
    def gravity_law(self) -> Optional[Motion]:
        """None = gravity stays."""
    global_acceleration: _Vector
    """A second acceleration of all bodies [m/s², W]. Raises InputError."""
    def step(self, steps: int = ...) -> None:
        """So many time steps, without the interpreter's lock. Raises InvariantError."""
    @property
    def time(self) -> float:
        """Simulated time [s]."""
    @property
    def steps_per_second_by_size(self) -> float:
        """Time steps per second that the sizes of the bodies that move ask for [1/s]."""
    @property
    def step_count(self) -> int:
        """Time steps done."""
    @property
    def settings(self) -> Settings:
        """Takes effect at the next step. Raises InputError."""
    @settings.setter
    def settings(self, settings: Settings) -> None: ...
    def set_checks(self, checks: Union[Checks, str]) -> None:
        """What every step checks from now on."""
    def save(self) -> bytes:
        """Everything that the world is, so that it goes on bit by bit as it would have."""
    @staticmethod
    def restore(snapshot: bytes) -> World:
        """A world as it was saved. Raises InputError."""
    def load(self, state: Union[RollbackState, bytes], /) -> None:
        """Becomes what was kept or saved. Raises InputError."""
    def keep(self, state: RollbackState) -> None:
        """Overwrites a kept state with what the world is."""
    def contacts(self) -> Structured:
        """Of the last step, by (a, b): an array of contact_dtype."""
    def batches(self) -> list[BatchInfo]:
        """Of the last step, by their lowest body."""
    @property
    def statistics(self) -> Statistics:
        """Of the last step."""
    @property
    def faults(self) -> tuple[FaultInfo, ...]:
        """All so far."""
    def set_tracing(self, tracing: Union[Tracing, str]) -> None:
        """Of the following steps; off at first."""
    def trace(self, id: BodyId) -> BodyTrace:
        """What the last step did with a body. Raises StaleIdError."""
    event_level: _EventLevel
    """Which events the following steps collect; none at first."""
    def events(self) -> Structured:
        """What happened in the last step: an array of event_dtype."""
    def kinetic_energy(self) -> float:
        """[J]"""
    def potential_energy(self) -> float:
        """[J], zero at the origin."""
    def linear_momentum(self) -> Floats:
        """Of all dynamic bodies [N·s, W]."""
    def angular_momentum(self) -> Floats:
        """Of all dynamic bodies about the origin [N·m·s, W]."""
    def state_hash(self) -> int:
        """Equal states have equal hashes."""
    def shape(self, id: BodyId) -> Shape:
        """In its own frame."""
    def name(self, id: BodyId) -> str:
        """As the description said."""
    def material(self, id: BodyId) -> MaterialId:
        """What it is made of."""
    def pose(self, id: BodyId) -> Pose:
        """Of the shape's frame in W [m]."""
    def centre_of_mass(self, id: BodyId) -> Floats:
        """[m, W]"""
    def linear_velocity(self, id: BodyId) -> Floats:
        """Of the centre of mass [m/s, W]."""
    def angular_velocity(self, id: BodyId) -> Floats:
        """[rad/s, W]"""
    def mass(self, id: BodyId) -> float:
        """[kg]; infinite for fixed bodies."""
    def principal_inertia(self, id: BodyId) -> Floats:
        """About the centre of mass [kg·m², B]; infinite for fixed bodies."""
    def principal_axes(self, id: BodyId) -> Floats:
        """B to W: a quaternion (w, x, y, z)."""
    def is_fixed(self, id: BodyId) -> bool:
        """Whether it never moves."""
    def is_asleep(self, id: BodyId) -> bool:
        """Whether it sleeps."""
    def set_pose(self, id: BodyId, pose: Pose) -> None:
        """Of the shape's frame in W [m]."""
    def set_fixed(self, id: BodyId, fixed: bool) -> None:
        """A half-space stays fixed."""
    def wake(self, ids: Union[BodyId, Ids], /) -> None:
        """Wakes a body, or all of some ids. Raises StaleIdError."""
    def set_linear_velocity(self, id: BodyId, v: ArrayLike) -> None:
        """[m/s, W]"""
    def set_angular_velocity(self, id: BodyId, w: ArrayLike) -> None:
        """[rad/s, W]"""
    def apply_force(self, id: BodyId, force: ArrayLike) -> None:
        """At the centre of mass for the next step [N, W]."""
    def apply_torque(self, id: BodyId, torque: ArrayLike) -> None:
        """For the next step [N·m, W]."""
    def apply_impulse(self, id: BodyId, impulse: ArrayLike) -> None:
        """At once, at the centre of mass [N·s, W]."""
    def apply_angular_impulse(self, id: BodyId, impulse: ArrayLike) -> None:
        """At once [N·m·s, W]."""
    def set_constant_force(self, id: BodyId, force: ArrayLike) -> None:
        """In every step from now on [N, W]."""
    def set_constant_torque(self, id: BodyId, torque: ArrayLike) -> None:
        """In every step from now on [N·m, W]."""
    def apply_force_at(self, id: BodyId, force: ArrayLike, point: ArrayLike) -> None:
        """For the next step [N, W] at a point [m, W]."""
    def apply_impulse_at(self, id: BodyId, impulse: ArrayLike, point: ArrayLike) -> None:
        """At once [N·s, W] at a point [m, W]."""
    def set_poses(self, ids: Ids, positions: ArrayLike, orientations: ArrayLike) -> None:
        """Positions (n, 3) [m, W] and quaternions (w, x, y, z) (n, 4). If one is refused, nothing is written."""
    def set_linear_velocities(self, ids: Ids, v: ArrayLike) -> None:
        """[m/s, W], shape (n, 3)."""
    def set_angular_velocities(self, ids: Ids, w: ArrayLike) -> None:
        """[rad/s, W], shape (n, 3)."""
    def apply_forces(self, ids: Ids, forces: ArrayLike) -> None:
        """[N, W], shape (n, 3)."""
    def apply_torques(self, ids: Ids, torques: ArrayLike) -> None:
        """[N·m, W], shape (n, 3)."""
    def apply_impulses(self, ids: Ids, impulses: ArrayLike) -> None:
        """[N·s, W], shape (n, 3)."""
    def apply_angular_impulses(self, ids: Ids, impulses: ArrayLike) -> None:
        """[N·m·s, W], shape (n, 3)."""
    def set_constant_forces(self, ids: Ids, forces: ArrayLike) -> None:
        """[N, W], shape (n, 3)."""
    def set_constant_torques(self, ids: Ids, torques: ArrayLike) -> None:
        """[N·m, W], shape (n, 3)."""
    def cast_ray(self, ray: Ray, *, excluding: Ids = ..., groups: Sequence[GroupId] = ...) -> Optional[RayHit]:
        """The nearest body that a ray hits; of several at one distance that with the lowest id. Of this and the
        following questions: excluding some bodies, and about those of some groups only; never about sensors. Raises
        InputError."""
    def cast_ray_through(self, ray: Ray, *, excluding: Ids = ..., groups: Sequence[GroupId] = ...) -> list[RayHit]:
        """All parts of bodies that a ray hits, by distance, body and part. Raises InputError."""
    def cast_rays(
        self, rays: Sequence[Ray], *, excluding: Ids = ..., groups: Sequence[GroupId] = ...
    ) -> list[Optional[RayHit]]:
        """As cast_ray() for each ray, on the threads of the world and without the interpreter's lock. Raises
        InputError."""
    def cast_shape(
        self, shape: Shape, pose: Pose, way: ArrayLike, *, excluding: Ids = ..., groups: Sequence[GroupId] = ...
    ) -> Optional[BodyHit]:
        """The first body that a shape meets which moves without turning from a pose along a way [m, W]. Raises
        InputError."""
    @overload
    def overlap(
        self, shape: Shape, pose: Pose, *, excluding: Ids = ..., groups: Sequence[GroupId] = ...
    ) -> list[Overlap]:
        """The parts of bodies that have a point in common with a shape, or with a box along the axes of W of given
        corners [m, W], by body and part. Raises InputError."""
    @overload
    def overlap(
        self, lower: ArrayLike, upper: ArrayLike, *, excluding: Ids = ..., groups: Sequence[GroupId] = ...
    ) -> list[Overlap]: ...
    @overload
    def closest_points(
        self, shape: Shape, pose: Pose, reach: float, *, excluding: Ids = ..., groups: Sequence[GroupId] = ...
    ) -> list[NearBody]:
        """The bodies within reach [m] of a shape, by distance and body; or the closest points of two bodies. Raises
        InputError, StaleIdError."""
    @overload
    def closest_points(self, a: BodyId, b: BodyId) -> ClosestPoints: ...
    def add_group(self, name: str) -> GroupId:
        """Raises InputError for an empty or used name, or beyond most_groups."""
    @property
    def group_names(self) -> tuple[str, ...]:
        """Of all groups, in the order of their ids."""
    def set_groups_touch(self, a: GroupId, b: GroupId, touch: Union[Touch, str]) -> None:
        """Whether bodies of two groups, or of one, touch; at first all do. Raises InputError."""
    def groups_touch(self, a: GroupId, b: GroupId) -> Touch:
        """Raises InputError."""
    def set_groups(self, id: BodyId, groups: Sequence[GroupId]) -> None:
        """Puts a body into these groups and no others. Raises InputError, StaleIdError."""
    def groups(self, id: BodyId) -> list[GroupId]:
        """Of a body, ascending. Raises StaleIdError."""
    def set_pair_touch(self, a: BodyId, b: BodyId, touch: Optional[Union[Touch, str]]) -> None:
        """An exception of two bodies from what their groups say; None = no exception. Raises InputError,
        StaleIdError."""
    def pair_touch(self, a: BodyId, b: BodyId) -> Optional[Touch]:
        """The exception of two bodies, if there is one. Raises StaleIdError."""
    def is_sensor(self, id: BodyId) -> bool:
        """Whether it touches nobody. Raises StaleIdError."""
    def sensed(self) -> list[Sensed]:
        """Who was inside which sensor in the last step, by sensor and body."""
    def set_gravity_factor(self, id: BodyId, factor: float) -> None:
        """Of the global accelerations that it feels, -1e3 to 1e3."""
    def gravity_factor(self, id: BodyId) -> float:
        """Of the global accelerations that it feels."""
    def set_damping(self, id: BodyId, linear: float, angular: float) -> None:
        """Rates at which its velocities decay [1/s], 0 to 1e6."""
    def linear_damping(self, id: BodyId) -> float:
        """[1/s]"""
    def angular_damping(self, id: BodyId) -> float:
        """[1/s]"""
    def set_locked(self, id: BodyId, axes: Sequence[Union[JointAlong, str]]) -> None:
        """Along and about which axes of W it does not move; none = it is free. Raises InputError, StaleIdError."""
    def locked(self, id: BodyId) -> tuple[JointAlong, ...]:
        """Ascending."""
    def set_user_data(self, id: BodyId, data: int) -> None:
        """A number of the user's own, 0 to 2⁶⁴ - 1."""
    def user_data(self, id: BodyId) -> int:
        """0 unless it was set."""
    def set_motion(self, id: BodyId, motion: Motion, pivot: ArrayLike = ...) -> None:
        """Moves a fixed body by a law from now on; pivot: about which it turns [m, frame of the shape]. Raises
        InputError, StaleIdError."""
    def stop_motion(self, id: BodyId) -> None:
        """It stays where it is. Raises StaleIdError."""
    def motion(self, id: BodyId) -> Optional[Motion]:
        """The law that moves it, if one does. Raises StaleIdError."""
    def set_surface_velocity(self, id: BodyId, velocity: ArrayLike) -> None:
        """Lets the surface of a fixed body run over it, like a belt [m/s, frame of the shape]. Raises InputError,
        StaleIdError."""
    def surface_velocity(self, id: BodyId) -> Floats:
        """[m/s, frame of the shape]"""
    @property
    def frame_motion(self) -> Optional[Motion]:
        """The law by which the frame of the world moves; None = it rests. Raises InputError."""
    @frame_motion.setter
    def frame_motion(self, motion: Optional[Motion]) -> None: ...

class SceneRun:
    """A scene in a world, with its events."""

    def __init__(self, scene: Scene, settings: Optional[Settings] = ...) -> None:
        """settings: those of settings_for(scene) if None. Raises InputError."""
    @property
    def world(self) -> World:
        """May be changed between steps."""
    @property
    def scene(self) -> Scene:
        """As it was given."""
    def set_duration(self, seconds: float) -> None:
        """Changes when the run is over [s], > 0."""
    @property
    def ids(self) -> tuple[BodyId, ...]:
        """Ids of the scene's bodies, by index; stale once removed."""
    def step(self, steps: int = ...) -> None:
        """So many times: applies the events that are due, then steps the world."""
    def simulation_step(self) -> Statistics:
        """One simulation step of 1/30 s; returns the sum of the statistics of its time steps."""
    def hashed_simulation_step(self) -> tuple[Statistics, tuple[int, ...]]:
        """The same, and World.state_hash() after each of its time steps."""
    @property
    def steps_per_simulation_step(self) -> int:
        """Time steps of one simulation step."""
    def save(self) -> bytes:
        """The run as it is: scene, world, ids and the events that are still to come."""
    @staticmethod
    def restore(snapshot: bytes, source: str = ...) -> SceneRun:
        """A run as it was saved; source is shown in messages. Raises InputError."""

class Frame(_Record):
    """The state of all bodies at one moment; arrays have one row per body of the scene."""

    def __init__(
        self,
        time: float,
        position: ArrayLike = ...,
        orientation: ArrayLike = ...,
        linear_velocity: ArrayLike = ...,
        angular_velocity: ArrayLike = ...,
        asleep: ArrayLike = ...,
        statistics: Statistics = ...,
        kinetic_energy: float = ...,
        potential_energy: float = ...,
        step_hashes: ArrayLike = ...,
        contact_a: ArrayLike = ...,
        contact_b: ArrayLike = ...,
        contact_point: ArrayLike = ...,
        contact_normal: ArrayLike = ...,
        contact_distance: ArrayLike = ...,
        contact_impulse: ArrayLike = ...,
        joint_point: ArrayLike = ...,
        joint_force: ArrayLike = ...,
        joint_torque: ArrayLike = ...,
    ) -> None: ...
    @property
    def time(self) -> float:
        """[s]"""
    @property
    def position(self) -> Floats:
        """[m, W], shape (bodies, 3); NaN once the body was removed."""
    @property
    def orientation(self) -> Floats:
        """B to W: quaternions (w, x, y, z), shape (bodies, 4)."""
    @property
    def linear_velocity(self) -> Floats:
        """[m/s, W], shape (bodies, 3)."""
    @property
    def angular_velocity(self) -> Floats:
        """[rad/s, W], shape (bodies, 3)."""
    @property
    def asleep(self) -> NDArray[np.uint8]:
        """1 = asleep, shape (bodies,)."""
    @property
    def statistics(self) -> Statistics:
        """Of the time steps since the last frame."""
    @property
    def kinetic_energy(self) -> float:
        """[J]"""
    @property
    def potential_energy(self) -> float:
        """[J]"""
    @property
    def step_hashes(self) -> NDArray[np.uint64]:
        """World.state_hash() after each time step since the last frame; empty = not recorded."""
    @property
    def contact_a(self) -> NDArray[np.int64]:
        """Of contacts after the last time step: indices in Scene.bodies, shape (contacts,); empty = not recorded."""
    @property
    def contact_b(self) -> NDArray[np.int64]:
        """Indices in Scene.bodies, shape (contacts,)."""
    @property
    def contact_point(self) -> Floats:
        """[m, W], shape (contacts, 3)."""
    @property
    def contact_normal(self) -> Floats:
        """Unit, from B to A, W, shape (contacts, 3)."""
    @property
    def contact_distance(self) -> Floats:
        """Along the normal [m], negative = overlap, shape (contacts,)."""
    @property
    def contact_impulse(self) -> Floats:
        """That A received in the last time step [N s, W], shape (contacts, 3)."""
    @property
    def joint_point(self) -> Floats:
        """Where A is joined [m, W], shape (joints, 3), NaN once it broke; empty = not recorded."""
    @property
    def joint_force(self) -> Floats:
        """That A received there, mean over the last time step [N, W], shape (joints, 3)."""
    @property
    def joint_torque(self) -> Floats:
        """That A received besides [N m, W], shape (joints, 3)."""

class RecordingOptions(_Record):
    """What is recorded besides the state of the bodies, and how often."""

    def __init__(
        self,
        hashes_per_frame: int = ...,
        frame_rate: float = ...,
        contacts: bool = ...,
        joints: bool = ...,
    ) -> None: ...
    @property
    def hashes_per_frame(self) -> int:
        """Entries of Frame.step_hashes, so that each can be verified; 0 = none."""
    @property
    def frame_rate(self) -> float:
        """Frames per simulated second, at least 0.001, at most one per time step."""
    @property
    def contacts(self) -> bool:
        """Contacts with their impulses."""
    @property
    def joints(self) -> bool:
        """Forces of joints."""

class RecordingInfo(_Record):
    """What stands in a recording apart from its frames."""

    def __init__(
        self,
        scene: Scene = ...,
        settings: Sequence[tuple[str, str]] = ...,
        version: str = ...,
        machine: str = ...,
        frames: int = ...,
        bodies: int = ...,
        hashes_per_frame: int = ...,
        frame_rate: float = ...,
        contacts: bool = ...,
        joints: bool = ...,
    ) -> None: ...
    @property
    def scene(self) -> Scene:
        """As it was run."""
    @property
    def settings(self) -> tuple[tuple[str, str], ...]:
        """Field and value as text."""
    @property
    def version(self) -> str:
        """Of Cairn."""
    @property
    def machine(self) -> str:
        """Processor and operating system."""
    @property
    def frames(self) -> int:
        """How many."""
    @property
    def bodies(self) -> int:
        """How many, of the scene."""
    @property
    def hashes_per_frame(self) -> int:
        """0 = recorded without hashes."""
    @property
    def frame_rate(self) -> float:
        """Frames per simulated second [1/s]."""
    @property
    def contacts(self) -> bool:
        """Whether frames have contacts."""
    @property
    def joints(self) -> bool:
        """Whether frames have the forces of joints."""

class RecordingDifference(_Record):
    """Where a simulation left its recording."""

    def __init__(self, step: int = ..., body: Optional[int] = ..., what: str = ...) -> None: ...
    @property
    def step(self) -> int:
        """The first time step that differs."""
    @property
    def body(self) -> Optional[int]:
        """The first body of the scene that differs then, if one does."""
    @property
    def what(self) -> str:
        """What was recorded and what came out now."""

class RecordingWriter:
    """Writes a recording; what was appended can be read while it is written and after a crash."""

    def __init__(self, file: FilePath, scene: Scene, settings: Settings, options: RecordingOptions = ...) -> None:
        """Raises IoError."""
    def append(self, frame: Frame) -> None:
        """Raises IoError; frames before it stay readable."""
    def close(self) -> None:
        """Writes what is left and closes. Raises IoError."""
    def __enter__(self) -> RecordingWriter: ...
    def __exit__(self, *error: object) -> None: ...

class RecordingReader:
    """Reads a recording."""

    def __init__(self, file: FilePath) -> None:
        """Raises IoError if it is missing, truncated or not a recording."""
    @property
    def info(self) -> RecordingInfo:
        """Read once, when the file is opened."""
    def frame(self, index: int) -> Frame:
        """0 (the initial state) to info.frames - 1. Raises InputError."""

def setting_fields() -> tuple[SettingField, ...]:
    """All fields, in a fixed order."""
def preset_names() -> tuple[str, ...]:
    """The name of each preset, in the order of the enumeration."""
def get_field(settings: Settings, name: str) -> SettingValue:
    """Reads one field. Raises InputError for an unknown name."""
def validate(settings: Settings, gravity: ArrayLike) -> None:
    """Refuses settings that contradict each other. gravity: sum of all accelerations [m/s², W]. Raises InputError."""
def diagnostics_fields() -> tuple[DiagnosticsField, ...]:
    """All numbers, in a fixed order."""
def read_scene(file: FilePath) -> Scene:
    """Reads a scene file. Raises InputError, IoError."""
def parse_scene(json: str, source: str = ...) -> Scene:
    """Reads the text of a scene file; source is shown in messages. Raises InputError."""
def write_scene(scene: Scene, file: FilePath) -> None:
    """Writes a scene file. Raises IoError."""
def format_scene(scene: Scene) -> str:
    """The scene as the text of a scene file."""
def built_in_scenes() -> tuple[BuiltInScene, ...]:
    """All built-in scenes, in the order in which they are shown."""
def built_in_scene(name: str) -> Scene:
    """Such as 'cage384' or 'tower:20'. Raises InputError for an unknown name or a bad number."""
def scaled(scene: Scene, scales: Scales) -> Scene:
    """The same scene larger, slower and heavier: every value by its unit. Where lengths are multiplied by the
    square of the time gravity stays, and everything happens alike; with Scales(4**n, 2**n, 64**n) bit for
    bit after the same number of steps. Raises InputError."""
def is_built_in_scene(name: str) -> bool:
    """Whether a built-in scene has the name."""
def settings_for(scene: Scene, overrides: Optional[SettingOverrides] = ...) -> Settings:
    """The settings of a run: preset, then the scene's, then the overrides. Raises InputError."""
def write_checkpoint(run: SceneRun, file: FilePath) -> None:
    """Writes a run to a file, which is complete whatever happens. Raises IoError."""
def read_checkpoint(file: FilePath) -> SceneRun:
    """Raises IoError if it cannot be read, InputError if it is damaged."""
def is_frame_due(run: SceneRun, frame_rate: float) -> bool:
    """Whether a frame is to be taken after the last time step: the first at or after a multiple of 1/frame_rate."""
def capture_frame(run: SceneRun, statistics: Optional[Statistics] = ..., what: RecordingOptions = ...) -> Frame:
    """The present state of a run. statistics: of the time steps since the last frame. what: besides the bodies."""
def verify_recording(recording: RecordingReader, threads: int = ...) -> Optional[RecordingDifference]:
    """Simulates again and compares bit by bit. Returns the first difference, or None. Raises InputError."""
def export_csv(recording: RecordingReader, file: FilePath) -> None:
    """One row per frame and body."""
def export_vtk(recording: RecordingReader, file: FilePath) -> None:
    """A ParaView time series."""
def cast_ray(shape: Shape, pose: Pose, ray: Ray) -> Optional[SurfaceHit]:
    """Where a ray meets a shape; pose: of the shape in W. Raises InputError."""
def cast_shape(moving: Shape, pose: Pose, way: ArrayLike, other: Shape, other_pose: Pose) -> Optional[ShapeHit]:
    """Where a shape that moves from its pose along a way [m, W], at whose end it stops, touches another. Raises
    InputError."""
def overlap(a: Shape, pose_a: Pose, b: Shape, pose_b: Pose) -> bool:
    """Whether two shapes have a point in common. Raises InputError."""
def closest_points(a: Shape, pose_a: Pose, b: Shape, pose_b: Pose) -> ClosestPoints:
    """Closest points and signed distance of two shapes. Raises InputError."""
def contacts_of(a: Shape, pose_a: Pose, b: Shape, pose_b: Pose, margin: float) -> list[ShapeContact]:
    """The contacts of two shapes up to a distance [m], by part of A and then of B. Raises InputError."""
def integrate_accelerogram(interval: float, accelerations: ArrayLike, baseline: Union[Baseline, str]) -> TableMotion:
    """The motion, from rest, whose acceleration is straight between samples [m/s², W], shape (n, 3), an interval [s]
    apart. Raises InputError."""
