"""Types of what is given and returned."""

from os import PathLike
from typing import Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _core

#: Numbers in an array of numpy.
Floats = NDArray[np.float64]
#: Rows with named fields: contacts, events or ids.
Structured = NDArray[np.void]
#: The name of a file.
FilePath = Union[str, "PathLike[str]"]
#: Bodies: a sequence of their ids, or an array of them such as Bodies.id.
Ids = Union[Sequence[_core.BodyId], Structured]
#: Any shape.
Shape = Union[
    _core.Sphere, _core.Box, _core.Capsule, _core.HalfSpace, _core.Cylinder, _core.ConvexHull, _core.Compound,
    _core.Mesh, _core.HeightField,
]
#: What an event does.
EventAction = Union[
    _core.SetGravity, _core.SetVelocity, _core.GiveImpulse, _core.SetForce, _core.SetTorque, _core.RemoveBody
]
#: Any law of motion.
Motion = Union[_core.ConstantMotion, _core.SineMotion, _core.TableMotion]
#: The value of any field of the settings.
SettingValue = Union[bool, int, float, str]
