"""result.json and the numbers beside it."""
from __future__ import annotations

import dataclasses
import json
import pathlib
from typing import Any, Dict, List, Optional, Tuple

import numpy
from numpy.typing import NDArray

from capfit.result import Path, Result
from capfit.result_document import FORMAT, FORMAT_VERSION, document_of, result_of

_WEIGHTS = "weights"
_GAPS = "gaps"
_LINE_COLUMNS = 100


def write(result: Result, path: Path) -> None:
    """Writes result.json, and weights and gaps beside it."""
    file = pathlib.Path(path)
    file.write_text(_pretty(document_of(result), 0, _LINE_COLUMNS) + "\n", encoding="utf-8")
    if result.weights is not None:
        spheres, vertices = result.weights.shape
        facts: Dict[str, Any] = {"layout": "row-major", "spheres": spheres, "vertices": vertices}
        _write_numbers(result.weights, file, _WEIGHTS, "capfit-dense-weights", facts)
    if result.vertex_gaps is not None:
        facts = {"vertices": len(result.vertex_gaps), "metres_per_unit": result.metres_per_unit}
        _write_numbers(result.vertex_gaps, file, _GAPS, "capfit-vertex-gaps", facts)


def read(path: Path) -> Result:
    """Reads result.json, and what its options say is beside it."""
    file = pathlib.Path(path)
    result = _read_result(file)
    spheres, vertices = len(result.spheres), result.body.vertex_count
    beside: Dict[str, Any] = {}
    if result.options.get("skinning") == "dense":
        facts: Dict[str, Any] = {"layout": "row-major", "spheres": spheres, "vertices": vertices}
        beside["weights"] = _read_numbers(file, _WEIGHTS, "capfit-dense-weights", facts,
                                          (spheres, vertices))
    if result.options.get("want_vertex_gaps"):
        facts = {"vertices": vertices}
        beside["vertex_gaps"] = _read_numbers(file, _GAPS, "capfit-vertex-gaps", facts, (vertices,))
    return dataclasses.replace(result, **beside)


def _read_result(file: pathlib.Path) -> Result:
    document = _read_object(file)
    if document.get("format") != FORMAT:
        raise ValueError(f"{file} is no result: format is {document.get('format')!r}, must be "
                         f"{FORMAT!r}")
    if document.get("format_version") != FORMAT_VERSION:
        raise ValueError(f"{file} is of format version {document.get('format_version')}, this "
                         f"program reads {FORMAT_VERSION}")
    try:
        return result_of(document)
    except KeyError as error:
        raise ValueError(f"{file} has no member {error}") from None
    except (AttributeError, TypeError, ValueError) as error:
        raise ValueError(f"{file} is no result: {error}") from None


def _write_numbers(
    numbers: NDArray[numpy.float32], file: pathlib.Path, ending: str, format_name: str,
    facts: Dict[str, Any],
) -> None:
    data = file.with_suffix(f".{ending}.f32")
    header = {"format": format_name, "version": 1, "dtype": "float32", "byte_order": "little",
              **facts, "data": data.name}
    text = json.dumps(header, indent=2, ensure_ascii=False)
    file.with_suffix(f".{ending}.json").write_text(text + "\n", encoding="utf-8")
    numbers.astype("<f4").tofile(data)


def _read_numbers(
    file: pathlib.Path, ending: str, format_name: str, facts: Dict[str, Any],
    shape: Tuple[int, ...],
) -> Optional[NDArray[numpy.float32]]:
    """None where there is no such file. ValueError: it belongs to another result."""
    header_file = file.with_suffix(f".{ending}.json")
    if not header_file.exists():
        return None
    header = _read_object(header_file)
    expected = {"format": format_name, "version": 1, "dtype": "float32", "byte_order": "little",
                **facts}
    for name, value in expected.items():
        if header.get(name) != value:
            raise ValueError(f"{header_file}: {name} is {header.get(name)!r}, must be {value!r} to "
                             f"belong to {file.name}")
    numbers = numpy.fromfile(header_file.with_name(str(header.get("data"))), "<f4")
    if numbers.size != numpy.prod(shape):
        raise ValueError(f"{header.get('data')} holds {numbers.size} numbers, must hold "
                         f"{' x '.join(map(str, shape))}")
    return numbers.astype(numpy.float32, copy=False).reshape(shape)


def _read_object(file: pathlib.Path) -> Dict[str, Any]:
    document = json.loads(file.read_text(encoding="utf-8"))
    if not isinstance(document, dict):
        raise ValueError(f"{file} is no JSON object")
    return document


def _pretty(value: Any, indent: int, used: int) -> str:
    """Broken where it does not fit into a line; lists of plain values never are."""
    line = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    items: List[Tuple[str, Any]] = []
    if isinstance(value, dict):
        items = [(json.dumps(name, ensure_ascii=False) + ": ", one) for name, one in value.items()]
    elif isinstance(value, list) and any(isinstance(one, (dict, list)) for one in value):
        items = [("", one) for one in value]
    if not items or used + len(line) < _LINE_COLUMNS:
        return line
    margin = "\n" + " " * (indent + 2)
    inner = indent + 2
    lines = [margin + name + _pretty(one, inner, inner + len(name)) for name, one in items]
    return line[0] + ",".join(lines) + margin[:-2] + line[-1]
