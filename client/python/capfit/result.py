"""A fitted set of spheres and capsules, and all that is known about it."""
from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy
from numpy.typing import ArrayLike, NDArray

from capfit.errors import FitWarning

FloatArray = NDArray[numpy.float64]
Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Landmark:
    """A point on or in the body; `method` is "measured", "ratio", "caller" or "skeleton"."""

    position: Tuple[float, float, float]
    method: Optional[str] = None
    confidence: float = 0.0


@dataclass(frozen=True)
class GapStatistics:
    """Distances from the body's surface to the primitives', in metres."""

    mean_m: float
    p95_m: float
    max_m: float


@dataclass(frozen=True)
class PartMetrics:
    """How good the result is for one part of the body; meanings: v1.PartMetrics."""

    sphere_count: int
    capsule_count: int
    volume_m3: float
    volume_error: float
    outside: float
    uncovered: float
    mean_distance_percent: float
    volume_ratio: float
    gap: GapStatistics
    surface_out: float
    vertices_out: int
    max_out_m: float


@dataclass(frozen=True)
class Metrics:
    """How good the result is: volume_error is the paper's E_r, primitive_count its n_p; all
    meanings: v1.Metrics. `parts` has one for each fitted part, by name."""

    primitive_count: int
    volume_error: float
    outside: float
    uncovered: float
    mean_distance_percent: float
    max_distance_percent: float
    max_gap_m: float
    volume_ratio: float
    mirror_error: float
    vertices_out: int
    max_out_m: float
    sphere_count: int
    capsule_count: int
    intersection_over_union: float
    gap: GapStatistics
    surface_out: float
    parts: Dict[str, PartMetrics] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Similarity:
    """y = scale * (rotation @ x) + translation."""

    rotation: FloatArray  # (3, 3), orthonormal
    scale: float
    translation: FloatArray  # (3,)

    def __call__(self, points: ArrayLike) -> FloatArray:
        """The points (..., 3) carried over."""
        turned = numpy.asarray(points, numpy.float64) @ self.rotation.T
        moved: FloatArray = self.scale * turned + self.translation
        return moved


@dataclass(frozen=True)
class MeshPart:
    """Pieces of one part of a file, and what they were taken for."""

    name: str
    material: str
    kind: str  # "body", "clothing", "shoe", "skirt", "hair", "inner", "accessory", "fragment"
    is_included: bool
    reason: str
    shell_count: int
    face_count: int
    area_share: float


@dataclass(frozen=True)
class BodyFacts:
    """The mesh that was fitted, as it came."""

    vertex_count: int
    face_count: int
    box_min: Tuple[float, float, float]
    box_max: Tuple[float, float, float]
    height_m: float
    is_symmetric: bool
    parts: Tuple[MeshPart, ...] = ()  # of a file of several; empty: the mesh was one surface


@dataclass(frozen=True, eq=False)
class FeaturePolygon:
    """A cross section of the body with the circles fitted to it."""

    name: str
    part: str
    outline: FloatArray  # (points, 3)
    circles: FloatArray  # (circles, 4): x, y, z, r
    outside_area_ratio: float


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint of the skeleton that came with the mesh, where its node stands in the file."""

    name: str
    parent: Optional[int]  # index of the nearest joint above it
    human_bone: str  # what the file itself calls it (VRM: "leftLowerArm"), often empty
    to_mesh: FloatArray  # (3, 4): from the node's own frame to the mesh's
    node: Optional[int]  # index among the file's nodes


@dataclass(frozen=True, eq=False)
class SparseRow:
    """The vertices that carry one sphere's centre: weights @ vertices[indices]."""

    vertices: NDArray[numpy.int32]
    weights: NDArray[numpy.float32]


@dataclass(frozen=True, eq=False)
class BoneRow:
    """The joints that carry one sphere's centre: the sum of weight * (to_mesh @ (offset, 1))."""

    joints: NDArray[numpy.int32]
    weights: NDArray[numpy.float32]
    offsets: FloatArray  # (entries, 3): in the joint's own frame and unit


@dataclass(frozen=True, eq=False)
class Result:
    """What a fit gives; lengths in the mesh's own unit and axes unless the name has a unit.

    The convex hull of the two spheres of a capsule is a tapered capsule; the union of all spheres
    and capsules stands for the body. Lists named sphere_... and capsule_... run beside them.
    """

    spheres: FloatArray  # (k, 4): x, y, z, r
    capsules: NDArray[numpy.int32]  # (c, 2): indices of spheres, the smaller first
    sphere_names: List[str]  # "left_forearm_2", ...: unique
    sphere_parts: List[str]  # "torso", "left_arm", ...
    sphere_mirrors: List[Optional[int]]  # the sphere on the other side; None: not symmetric
    sphere_places: List[Optional[Dict[str, Any]]]  # v1.BodyPlace: what makes this set a layout
    sphere_polygons: Optional[List[Optional[int]]]  # index of feature_polygons; None: not asked for
    capsule_parts: List[str]
    landmarks: Dict[str, Landmark]
    warnings: List[FitWarning]
    metrics: Metrics
    feature_polygons: Optional[List[FeaturePolygon]]  # None: not asked for
    unit: Optional[str]  # "metre", "centimetre", "millimetre", "inch": told or found
    metres_per_unit: float
    up_axis: Optional[str]  # "x", "y", "z": told or found; None: no positive axis points up
    body_from_caller: Similarity  # to metres, +Y up, facing +Z, lowest point at y = 0
    body: BodyFacts
    options: Dict[str, Any]  # that held in the end, as in result.json
    version: str  # of the server
    request_id: str
    stages: Dict[str, float]  # seconds of each
    seconds: float
    weights: Optional[NDArray[numpy.float32]] = None  # (k, n), where skinning="dense"
    vertex_gaps: Optional[NDArray[numpy.float32]] = None  # (n,), where want_vertex_gaps
    sparse_weights: Optional[List[SparseRow]] = None  # of each sphere, where skinning="sparse"
    bone_weights: Optional[List[BoneRow]] = None  # of each sphere, where skinning="bones"
    exports: Dict[str, bytes] = field(default_factory=dict)  # files by name, where asked for
    joints: Tuple[Joint, ...] = ()  # of the mesh's file; empty: it has no skeleton
    # The joint that carries each best, where a skeleton holds the mesh.
    sphere_joints: Optional[List[int]] = None
    sphere_joint_drift_m: Optional[List[float]] = None  # by how much it misleads: v1.Sphere
    capsule_joints: Optional[List[int]] = None

    def apply(self, moved_vertices: ArrayLike) -> FloatArray:
        """The sphere centres (k, 3) for the moved vertices (n, 3); (frames, k, 3) for
        (frames, n, 3). ValueError: no weights of vertices (skinning="sparse" or "dense" brings
        them), or another shape."""
        if self.weights is None and self.sparse_weights is None:
            raise ValueError('the result has no weights of vertices: approximate with '
                             'skinning="sparse"')
        vertices = numpy.asarray(moved_vertices, numpy.float64)
        count = self.body.vertex_count if self.weights is None else self.weights.shape[1]
        if vertices.ndim not in (2, 3) or vertices.shape[-2:] != (count, 3):
            raise ValueError(f"moved_vertices is of shape {vertices.shape}, must be ({count}, 3) "
                             f"or (frames, {count}, 3)")
        # Relative to one vertex: what a row's sum lacks to 1 in single precision is then not
        # multiplied by the distance from the origin.
        origin = vertices[..., :1, :]
        if self.weights is None:
            rows = [row.weights.astype(numpy.float64) @ (vertices[..., row.vertices, :] - origin)
                    for row in self.sparse_weights or []]
            carried: FloatArray = origin + numpy.stack(rows, axis=-2)
            return carried
        centers: FloatArray = origin + self.weights.astype(numpy.float64) @ (vertices - origin)
        return centers

    def apply_joints(self, to_mesh: ArrayLike) -> FloatArray:
        """The sphere centres (k, 3) with the joints of the skeleton at `to_mesh` (joints, 3, 4),
        each from its own frame to the mesh's; (frames, k, 3) for (frames, joints, 3, 4).
        ValueError: no weights of joints (skinning="bones" brings them), or another shape."""
        if self.bone_weights is None:
            raise ValueError('the result has no weights of joints: approximate with '
                             'skinning="bones"')
        placings = numpy.asarray(to_mesh, numpy.float64)
        shape = (len(self.joints), 3, 4)
        if placings.ndim not in (3, 4) or placings.shape[-3:] != shape:
            raise ValueError(f"to_mesh is of shape {placings.shape}, must be {shape} or "
                             f"(frames, *{shape})")
        rows = []
        for row in self.bone_weights:
            of_row = placings[..., row.joints, :, :]
            placed = numpy.einsum("...jab,jb->...ja", of_row[..., :3], row.offsets)
            rows.append(numpy.einsum("j,...ja->...a", row.weights.astype(numpy.float64),
                                     placed + of_row[..., 3]))
        centers: FloatArray = numpy.stack(rows, axis=-2)
        return centers

    def to_json(self, path: Path) -> None:
        """Writes result.json as the command line does; weights and gaps go beside it, as
        NAME.weights.json and .f32, NAME.gaps.json and .f32."""
        from capfit import result_file

        result_file.write(self, path)

    @staticmethod
    def load(path: Path) -> Result:
        """Reads a result.json, with the weights and gaps beside it where its options say that there
        are some. ValueError names what is wrong with a file."""
        from capfit import result_file

        return result_file.read(path)
