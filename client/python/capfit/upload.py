"""A mesh as the messages of an upload."""
from __future__ import annotations

import os
import pathlib
from typing import Any, Callable, Iterator, List, Optional, Sequence, Tuple, Union, cast

import numpy
from numpy.typing import ArrayLike, NDArray

from capfit.v1 import mesh_pb2, service_pb2
from capfit.words import number_of

Body = Union[str, "os.PathLike[str]", bytes]
Faces = Union[ArrayLike, Sequence[Sequence[int]]]
# Makes the messages of the upload, anew for each attempt.
Upload = Callable[[Any], Iterator[Any]]

_CHUNK_BYTES = 256 * 1024
_LARGEST_INDEX = 2**32 - 1


def file_upload(body: Body, file_format: str) -> Tuple[Any, Upload]:
    """The header of a mesh file, given its path or its bytes, and the messages of the upload.

    "auto" goes by the path's ending, else the server looks at the bytes. OSError: cannot be read.
    """
    data = body if isinstance(body, bytes) else pathlib.Path(body).read_bytes()
    enum = mesh_pb2.MeshFileFormat.DESCRIPTOR
    number = number_of(enum, "file_format", file_format)
    if number == 0 and not isinstance(body, bytes):
        ending = pathlib.Path(body).suffix[1:].upper()
        value = enum.values_by_name.get(f"MESH_FILE_FORMAT_{ending}")
        number = value.number if value else 0
    encoding: Any = mesh_pb2.FileEncoding(byte_count=len(data))
    encoding.format = number

    def messages(first: Any) -> Iterator[Any]:
        yield first
        for begin in range(0, len(data), _CHUNK_BYTES):
            chunk = mesh_pb2.MeshChunk(file_bytes=data[begin:begin + _CHUNK_BYTES])
            yield service_pb2.ApproximateBodyRequest(chunk=chunk)

    return mesh_pb2.MeshHeader(file=encoding), messages


def array_upload(vertices: ArrayLike, faces: Faces) -> Tuple[Any, Upload]:
    """The header of arrays and the messages of the upload: float32 vertices go in single precision,
    all others in double; faces of an (m, 3) array as triangles, all others as polygons.

    ValueError and TypeError: the arrays are not of that shape and kind.
    """
    positions = _positions(vertices)
    face_count, fields = _face_fields(faces)
    is_single = positions.dtype == numpy.float32
    fields.insert(0, ("positions" if is_single else "positions_double", positions.ravel()))
    encoding = mesh_pb2.ArrayEncoding(vertex_count=len(positions), face_count=face_count)

    def messages(first: Any) -> Iterator[Any]:
        yield first
        for name, numbers in fields:
            step = _CHUNK_BYTES // numbers.itemsize
            for begin in range(0, len(numbers), step):
                piece = {name: numbers[begin:begin + step].tolist()}
                chunk = mesh_pb2.MeshChunk(arrays=mesh_pb2.MeshArrays(**piece))
                yield service_pb2.ApproximateBodyRequest(chunk=chunk)

    return mesh_pb2.MeshHeader(arrays=encoding), messages


def _positions(vertices: ArrayLike) -> NDArray[Any]:
    positions = numpy.asarray(vertices)
    if positions.dtype != numpy.float32:
        positions = positions.astype(numpy.float64)
    if positions.ndim != 2 or positions.shape[1] != 3:
        raise ValueError(f"vertices is of shape {positions.shape}, must be (n, 3)")
    return positions


def _face_fields(faces: Faces) -> Tuple[int, List[Tuple[str, NDArray[Any]]]]:
    """How many faces, and the fields of MeshArrays that hold them."""
    rows = _rectangular(faces)
    if rows is not None and rows.shape[1] == 3:
        return len(rows), [("triangle_indices", _indices(rows.ravel()))]
    if rows is not None:
        sizes = numpy.full(len(rows), rows.shape[1])
        corners = rows.ravel()
    else:
        polygons = [numpy.asarray(face) for face in cast(Any, faces)]
        sizes = numpy.array([len(face) for face in polygons])
        corners = numpy.concatenate(polygons) if polygons else numpy.empty(0, numpy.int64)
    return len(sizes), [("face_sizes", _indices(sizes)), ("face_indices", _indices(corners))]


def _rectangular(faces: Faces) -> Optional[NDArray[Any]]:
    """The faces as an array, or None where they have different numbers of corners."""
    polygons: Any = faces
    if not isinstance(polygons, numpy.ndarray) and len({len(face) for face in polygons}) != 1:
        return None
    rows = numpy.asarray(polygons)
    if rows.ndim != 2:
        raise ValueError(f"faces is of shape {rows.shape}, must be (m, corners) or a list of lists")
    return rows


def _indices(numbers: NDArray[Any]) -> NDArray[numpy.uint32]:
    if numbers.size and not numpy.issubdtype(numbers.dtype, numpy.integer):
        raise TypeError(f"faces holds {numbers.dtype}, must hold whole numbers")
    bad = (numbers < 0) | (numbers > _LARGEST_INDEX)
    if bad.any():
        raise ValueError(f"faces holds {numbers[bad][0]}, which is no vertex index")
    return numbers.astype(numpy.uint32)
