"""The options of a fit as the wire's message."""
from __future__ import annotations

from typing import Any, Iterable, List, Mapping, Optional, Union

from capfit.result import Landmark
from capfit.v1 import options_pb2
from capfit.words import number_of

Words = Union[str, Iterable[str]]
Landmarks = Mapping[str, Union[Landmark, Iterable[float]]]


def fit_options(
    *,
    max_primitives: Optional[int],
    max_spheres: Optional[int],
    max_capsules: Optional[int],
    max_polygon_error: Optional[float],
    engine: str,
    parts: Optional[Words],
    require_parts: Optional[Words],
    fit_mode: str,
    quality: str,
    tolerance_m: float,
    sex: str,
    skinning: str,
    landmarks: Optional[Landmarks],
    seed: int,
    want_feature_polygons: bool,
    want_vertex_gaps: bool,
    include_parts: Iterable[str],
    exclude_parts: Iterable[str],
    include_hair: bool,
    include_skirt: bool,
) -> Any:
    """A v1.FitOptions; what each means: Client.approximate.

    ValueError for what the wire cannot even say: a word that is none, several budgets at once. The
    ranges of numbers are left to the server.
    """
    options = options_pb2.FitOptions()
    _set_budget(options, max_primitives, max_spheres, max_capsules, max_polygon_error)
    for name, word in (("fit_mode", fit_mode), ("quality", quality), ("sex", sex),
                       ("skinning", skinning)):
        enum = options.DESCRIPTOR.fields_by_name[name].enum_type
        setattr(options, name, number_of(enum, name, word))
    options.parts.extend(_parts("parts", parts))
    options.require_parts.extend(_parts("require_parts", require_parts))
    _add_landmarks(options, landmarks or {})
    for name, value in (("engine", engine), ("tolerance_m", tolerance_m), ("seed", seed),
                        ("want_feature_polygons", want_feature_polygons),
                        ("want_vertex_gaps", want_vertex_gaps), ("include_hair", include_hair),
                        ("include_skirt", include_skirt)):
        _set(options, name, value)
    for name, names in (("include_parts", include_parts), ("exclude_parts", exclude_parts)):
        getattr(options, name).extend([names] if isinstance(names, str) else names)
    return options


def _set(message: Any, name: str, value: Any) -> None:
    try:
        setattr(message, name, value)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{name} is {value!r}: {error}") from None


def _set_budget(
    options: Any,
    max_primitives: Optional[int],
    max_spheres: Optional[int],
    max_capsules: Optional[int],
    max_polygon_error: Optional[float],
) -> None:
    apart = {"max_spheres": max_spheres, "max_capsules": max_capsules}
    whole = {"max_primitives": max_primitives, "max_polygon_error": max_polygon_error}
    given = [name for name, limit in {**whole, **apart}.items() if limit is not None]
    if len(given) > 1 and given != list(apart):
        raise ValueError(
            f"{' and '.join(given)} exclude each other: the budget is max_primitives, or "
            "max_spheres and/or max_capsules, or max_polygon_error")
    for name in given:
        budget = options.budget.spheres_and_capsules if name in apart else options.budget
        _set(budget, name, {**whole, **apart}[name])


def _parts(name: str, words: Optional[Words]) -> List[int]:
    if words is None:
        return []
    enum = options_pb2.BodyPartGroup.DESCRIPTOR
    every = [value.number for value in enum.values if value.number]
    listed = words.replace(",", " ").split() if isinstance(words, str) else list(words)
    if not listed and name == "parts":
        raise ValueError("parts names no part")
    numbers = [0 if word.lower() == "all" else number_of(enum, name, word) for word in listed]
    return every if 0 in numbers else numbers


def _add_landmarks(options: Any, landmarks: Landmarks) -> None:
    for name, given in landmarks.items():
        position = [float(x) for x in (given.position if isinstance(given, Landmark) else given)]
        if len(position) != 3:
            raise ValueError(f"landmarks[{name!r}] has {len(position)} numbers, must have 3")
        landmark = options.landmarks.add(name=name)
        landmark.position.x, landmark.position.y, landmark.position.z = position
