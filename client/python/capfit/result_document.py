"""A result as the members of result.json, and back. docs/result.schema.json describes them."""
from __future__ import annotations

import dataclasses
from typing import Any, Dict, List, Optional

import numpy

from capfit.errors import FitWarning
from capfit.result import (BodyFacts, BoneRow, FeaturePolygon, GapStatistics, Joint, Landmark,
                           MeshPart, Metrics, PartMetrics, Result, Similarity, SparseRow)

FORMAT = "capfit-result"
FORMAT_VERSION = 1

Document = Dict[str, Any]


def result_of(document: Document) -> Result:
    """KeyError, TypeError or ValueError: a member is missing or of another kind. Members that are
    not known are ignored."""
    polygons = document.get("feature_polygons")
    return Result(
        spheres=numpy.array(document["spheres"], numpy.float64).reshape(-1, 4),
        capsules=numpy.array(document["capsules"], numpy.int32).reshape(-1, 2),
        sphere_names=list(document["sphere_names"]),
        sphere_parts=list(document["sphere_parts"]),
        sphere_mirrors=list(document["sphere_mirrors"]),
        sphere_places=list(document["sphere_places"]),
        sphere_polygons=_optional_list(document.get("sphere_polygons")),
        capsule_parts=list(document["capsule_parts"]),
        landmarks={name: Landmark(**_known(Landmark, {**one, "position": tuple(one["position"])}))
                   for name, one in document["landmarks"].items()},
        warnings=[FitWarning(**_known(FitWarning, one)) for one in document["warnings"]],
        metrics=_metrics_of(document["metrics"]),
        feature_polygons=None if polygons is None else [_polygon_of(one) for one in polygons],
        unit=document["unit"],
        metres_per_unit=document["metres_per_unit"],
        up_axis=document["up_axis"],
        body_from_caller=_similarity_of(document["body_from_caller"]),
        body=_body_of(document["body"]),
        options=document["options"],
        version=document["version"],
        request_id=document.get("request_id", ""),
        stages=dict(document["stages"]),
        seconds=document["seconds"],
        sparse_weights=_sparse_of(document.get("sparse_weights")),
        bone_weights=_bones_of(document.get("bone_weights")),
        joints=tuple(_joint_of(joint) for joint in document.get("joints", ())),
        sphere_joints=_optional_list(document.get("sphere_joints")),
        sphere_joint_drift_m=_optional_list(document.get("sphere_joint_drift_m")),
        capsule_joints=_optional_list(document.get("capsule_joints")),
    )


def document_of(result: Result) -> Document:
    """In the order of the command line's files."""
    document: Document = {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "version": result.version,
        "unit": result.unit,
        "metres_per_unit": result.metres_per_unit,
        "up_axis": result.up_axis,
    }
    if result.request_id:
        document["request_id"] = result.request_id
    document.update({
        "body_from_caller": {"rotation": result.body_from_caller.rotation.ravel().tolist(),
                             "scale": result.body_from_caller.scale,
                             "translation": result.body_from_caller.translation.tolist()},
        "body": dataclasses.asdict(result.body),
        "options": result.options,
        "spheres": result.spheres.tolist(),
        "capsules": result.capsules.tolist(),
        "sphere_names": result.sphere_names,
        "sphere_parts": result.sphere_parts,
        "sphere_mirrors": result.sphere_mirrors,
        "sphere_places": result.sphere_places,
    })
    if result.sphere_polygons is not None:
        document["sphere_polygons"] = result.sphere_polygons
    document["capsule_parts"] = result.capsule_parts
    document.update(_skinning_document(result))
    document.update({
        "landmarks": {name: dataclasses.asdict(one) for name, one in result.landmarks.items()},
        "warnings": [dataclasses.asdict(one) for one in result.warnings],
        "metrics": dataclasses.asdict(result.metrics),
        "stages": result.stages,
        "seconds": result.seconds,
    })
    if result.feature_polygons is not None:
        document["feature_polygons"] = [
            {**vars(one), "outline": one.outline.tolist(), "circles": one.circles.tolist()}
            for one in result.feature_polygons]
    return document


def _skinning_document(result: Result) -> Document:
    document: Document = {}
    if result.joints:
        document["joints"] = [{**vars(joint), "to_mesh": joint.to_mesh.ravel().tolist()}
                              for joint in result.joints]
    for name in ("sphere_joints", "sphere_joint_drift_m", "capsule_joints"):
        if getattr(result, name) is not None:
            document[name] = getattr(result, name)
    if result.sparse_weights is not None:
        document["sparse_weights"] = {
            "vertex_count": result.body.vertex_count,
            "rows": [{"vertices": row.vertices.tolist(), "weights": row.weights.tolist()}
                     for row in result.sparse_weights]}
    if result.bone_weights is not None:
        document["bone_weights"] = {
            "rows": [{"joints": row.joints.tolist(), "weights": row.weights.tolist(),
                      "offsets": row.offsets.tolist()} for row in result.bone_weights]}
    return document


def _sparse_of(members: Optional[Document]) -> Optional[List[SparseRow]]:
    if members is None:
        return None
    return [SparseRow(numpy.array(row["vertices"], numpy.int32),
                      numpy.array(row["weights"], numpy.float32)) for row in members["rows"]]


def _bones_of(members: Optional[Document]) -> Optional[List[BoneRow]]:
    if members is None:
        return None
    return [BoneRow(numpy.array(row["joints"], numpy.int32),
                    numpy.array(row["weights"], numpy.float32),
                    numpy.array(row["offsets"], numpy.float64).reshape(-1, 3))
            for row in members["rows"]]


def _joint_of(members: Document) -> Joint:
    known = _known(Joint, members)
    known["to_mesh"] = numpy.array(members["to_mesh"], numpy.float64).reshape(3, 4)
    return Joint(**known)


def _known(kind: Any, members: Document) -> Document:
    """Without the members that a later version may have added."""
    names = {member.name for member in dataclasses.fields(kind)}
    return {name: value for name, value in members.items() if name in names}


def _optional_list(values: Optional[List[Any]]) -> Optional[List[Any]]:
    return None if values is None else list(values)


def _metrics_of(members: Document) -> Metrics:
    parts = {name: PartMetrics(**_with_gap(PartMetrics, part))
             for name, part in members["parts"].items()}
    known = _with_gap(Metrics, members)
    known["parts"] = parts
    return Metrics(**known)


def _with_gap(kind: Any, members: Document) -> Document:
    gap = GapStatistics(**_known(GapStatistics, members["gap"]))
    return {**_known(kind, members), "gap": gap}


def _polygon_of(members: Document) -> FeaturePolygon:
    known = _known(FeaturePolygon, members)
    known["outline"] = numpy.array(members["outline"], numpy.float64).reshape(-1, 3)
    known["circles"] = numpy.array(members["circles"], numpy.float64).reshape(-1, 4)
    return FeaturePolygon(**known)


def _similarity_of(members: Document) -> Similarity:
    return Similarity(
        rotation=numpy.array(members["rotation"], numpy.float64).reshape(3, 3),
        scale=members["scale"],
        translation=numpy.array(members["translation"], numpy.float64).reshape(3),
    )


def _body_of(members: Document) -> BodyFacts:
    known = _known(BodyFacts, members)
    known.update({name: tuple(members[name]) for name in ("box_min", "box_max")})
    known["parts"] = tuple(MeshPart(**_known(MeshPart, part)) for part in members.get("parts", ()))
    return BodyFacts(**known)
