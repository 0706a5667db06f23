"""Puts the messages of an answer together to one result, and holds the server to the contract."""
from __future__ import annotations

import dataclasses
from typing import Any, Callable, Dict, List, Optional

import numpy
from numpy.typing import NDArray

from capfit.errors import contract_broken
from capfit.result import Result
from capfit.result_document import result_of
from capfit.v1 import result_pb2
from capfit.words import message_document, word_of

ProgressFunction = Callable[[str, float], object]

# In the order of an answer: whether they may come more than once.
_PARTS = {"progress": True, "warning": True, "landmarks": False, "feature_polygon": True,
          "primitives": False, "skinning": True, "vertex_gaps": True,
          "export_chunk": True, "summary": False}
_ORDER = list(_PARTS)


def _float_array(message: Any, name: str) -> NDArray[Any]:
    """A repeated float as an array, a hundred times as fast as element by element: packed, the
    numbers are the end of the bytes of a message that has nothing else."""
    values = getattr(message, name)
    alone = type(message)()
    getattr(alone, name).MergeFrom(values)
    data = alone.SerializeToString()
    return numpy.frombuffer(data, "<f4", len(values), len(data) - 4 * len(values))


class Answer:
    """Use: add() each message in order, then result(). Both raise CapfitError "INTERNAL" where the
    answer breaks the contract. Parts of a later version of the contract are ignored."""

    def __init__(self, on_progress: Optional[ProgressFunction]) -> None:
        self._on_progress = on_progress
        self._last = ""
        self._document: Dict[str, Any] = {"warnings": [], "landmarks": {}}
        self._polygons: List[Dict[str, Any]] = []
        self._weights: Optional[NDArray[numpy.float32]] = None
        self._weight_count = 0
        self._gaps: Optional[NDArray[numpy.float32]] = None
        self._gap_count = 0
        self._exports: Dict[str, bytearray] = {}

    def add(self, response: Any) -> None:
        """Takes the next message."""
        part = response.WhichOneof("part")
        if part is None:
            return
        if self._last and (_ORDER.index(part) < _ORDER.index(self._last)
                           or part == self._last and not _PARTS[part]):
            raise contract_broken(f"{part} after {self._last}")
        self._last = part
        getattr(self, f"_add_{part}")(getattr(response, part))

    def result(self) -> Result:
        """The whole, after the last message."""
        if self._last != "summary":
            raise contract_broken("it ends without a summary")
        for name, numbers, count in (("weights", self._weights, self._weight_count),
                                     ("vertex gaps", self._gaps, self._gap_count)):
            if numbers is not None and count != numbers.size:
                raise contract_broken(f"it brings {count} {name} of {numbers.size}")
        try:
            result = result_of(self._document)
        except KeyError as error:
            raise contract_broken(f"it ends without {error}") from None
        exports = {name: bytes(data) for name, data in self._exports.items()}
        return dataclasses.replace(result, weights=self._weights, vertex_gaps=self._gaps,
                                   exports=exports)

    def _add_progress(self, progress: Any) -> None:
        stage = word_of(result_pb2.Stage.DESCRIPTOR, progress.stage)
        if stage is not None and self._on_progress is not None:
            self._on_progress(stage, progress.fraction_done)

    def _add_warning(self, warning: Any) -> None:
        self._document["warnings"].append(message_document(warning))

    def _add_landmarks(self, landmarks: Any) -> None:
        for landmark in landmarks.landmarks:
            members = message_document(landmark)
            self._document["landmarks"][members.pop("name")] = members

    def _add_feature_polygon(self, polygon: Any) -> None:
        members = message_document(polygon)
        circles = members["circles"]
        members["circles"] = [[*circle["center"], circle["radius"]] for circle in circles]
        self._polygons.append(members)

    def _add_primitives(self, primitives: Any) -> None:
        spheres = [message_document(sphere) for sphere in primitives.spheres]
        capsules = [message_document(capsule) for capsule in primitives.capsules]
        for capsule in capsules:
            if not 0 <= capsule["first_sphere"] < capsule["second_sphere"] < len(spheres):
                raise contract_broken(f"a capsule between spheres {capsule['first_sphere']} and "
                                      f"{capsule['second_sphere']} of {len(spheres)}")
        self._document.update({
            "spheres": [[*sphere["center"], sphere["radius"]] for sphere in spheres],
            "capsules": [[one["first_sphere"], one["second_sphere"]] for one in capsules],
            "sphere_names": [sphere["name"] for sphere in spheres],
            "sphere_parts": [sphere["part"] for sphere in spheres],
            "sphere_mirrors": [sphere.get("mirror") for sphere in spheres],
            "sphere_places": [sphere.get("place") for sphere in spheres],
            "sphere_polygons": [sphere.get("polygon") for sphere in spheres],
            "capsule_parts": [capsule["part"] for capsule in capsules],
        })
        self._add_joints(primitives)

    def _add_joints(self, primitives: Any) -> None:
        joints = [{"name": joint.name, "human_bone": joint.human_bone,
                   "parent": joint.parent if joint.HasField("parent") else None,
                   "to_mesh": list(joint.to_mesh),
                   "node": joint.node if joint.HasField("node") else None}
                  for joint in primitives.joints]
        if any(len(joint["to_mesh"]) != 12 for joint in joints):
            raise contract_broken("a joint whose to_mesh has not 12 numbers")
        if joints:
            self._document["joints"] = joints
        if not primitives.spheres or not primitives.spheres[0].HasField("joint"):
            return
        self._document.update({
            "sphere_joints": [sphere.joint for sphere in primitives.spheres],
            "sphere_joint_drift_m": [sphere.joint_drift_m for sphere in primitives.spheres],
            "capsule_joints": [capsule.joint for capsule in primitives.capsules],
        })
        indices = self._document["sphere_joints"] + self._document["capsule_joints"]
        if not all(0 <= index < len(joints) for index in indices):
            raise contract_broken(f"a joint beyond the {len(joints)} that there are")

    def _add_skinning(self, block: Any) -> None:
        form = block.WhichOneof("weights")
        if form == "dense":
            self._add_dense(block)
        elif form is not None:
            self._add_rows(form, block)

    def _add_rows(self, form: str, block: Any) -> None:
        message = getattr(block, form)
        names = {"sparse": ("vertices", "vertex_steps", block.total_vertex_count),
                 "bones": ("joints", "joints", len(self._document.get("joints", ())))}
        name, field, limit = names[form]
        indices = numpy.array(getattr(message, field), numpy.int64)
        weights = _float_array(message, "weights")
        ends = numpy.cumsum(message.row_sizes)
        per_index = {"sparse": 0, "bones": 3}[form]
        if (len(ends) != len(self._document.get("spheres", ()))
                or (min(message.row_sizes, default=0) < 0)
                or not len(indices) == len(weights) == (ends[-1] if len(ends) else 0)
                or (len(indices) and not (indices.min() >= 0 and indices.max() < limit))
                or form == "bones" and len(message.offsets) != per_index * len(indices)):
            raise contract_broken(f"{form} weights that do not fit together")
        rows = []
        for begin, end in zip([0, *ends[:-1]], ends):
            members = indices[begin:end]
            if form == "sparse":
                members = numpy.cumsum(members)
                if len(members) and members[-1] >= limit:
                    raise contract_broken(f"sparse weights of a vertex beyond {limit}")
            row = {name: members.tolist(), "weights": weights[begin:end].tolist()}
            if form == "bones":
                numbers = numpy.array(message.offsets[3 * begin:3 * end])
                row["offsets"] = numbers.reshape(-1, 3).tolist()
            rows.append(row)
        self._document[f"{form[:-1] if form == 'bones' else form}_weights"] = {"rows": rows}

    def _add_dense(self, block: Any) -> None:
        if self._weights is None:
            shape = (block.total_sphere_count, block.total_vertex_count)
            self._weights = numpy.empty(shape, numpy.float32)
        dense = block.dense
        rows = slice(block.first_sphere, block.first_sphere + block.sphere_count)
        columns = slice(dense.first_vertex, dense.first_vertex + dense.vertex_count)
        if (block.first_sphere * self._weights.shape[1]
                + block.sphere_count * dense.first_vertex != self._weight_count
                or self._weights[rows, columns].size != len(dense.weights)):
            raise contract_broken(f"{len(dense.weights)} weights for spheres {rows} and vertices "
                                  f"{columns} of {self._weights.shape}")
        numbers = _float_array(dense, "weights")
        self._weights[rows, columns] = numbers.reshape(block.sphere_count, dense.vertex_count)
        self._weight_count += len(numbers)

    def _add_export_chunk(self, chunk: Any) -> None:
        data = self._exports.setdefault(chunk.name, bytearray())
        if len(data) != chunk.first_byte or len(data) + len(chunk.data) > chunk.total_bytes:
            raise contract_broken(f"bytes of {chunk.name} are not where the ones before end")
        data += chunk.data

    def _add_vertex_gaps(self, chunk: Any) -> None:
        if self._gaps is None:
            self._gaps = numpy.empty(chunk.total_vertex_count, numpy.float32)
        end = chunk.first_vertex + len(chunk.gaps)
        if chunk.first_vertex != self._gap_count or end > self._gaps.size:
            raise contract_broken(f"gaps of vertices {chunk.first_vertex} to {end} of "
                                  f"{self._gaps.size}")
        self._gaps[chunk.first_vertex:end] = _float_array(chunk, "gaps")
        self._gap_count = end

    def _add_summary(self, summary: Any) -> None:
        members = message_document(summary)
        options, metrics = members["options"], members["metrics"]
        metrics["parts"] = {part.pop("part"): part for part in metrics["parts"]}
        members["stages"] = {time["stage"]: time["seconds"] for time in members["stages"]}
        self._document.update(members)
        self._document.update({
            "unit": options["unit"],
            "up_axis": options["up_axis"],
            "metres_per_unit": members["body_from_caller"]["scale"],
        })
        if options["want_feature_polygons"]:
            self._document["feature_polygons"] = self._polygons
        else:
            self._document.pop("sphere_polygons", None)
