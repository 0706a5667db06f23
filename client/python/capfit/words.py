"""The contract's enums and messages as the words and values of result.json.

LENGTH_UNIT_CENTIMETRE is "centimetre": lower case without the enum's name.
"""
from __future__ import annotations

import difflib
import re
from typing import Any, Dict, Iterable, Optional

# Short words that the command line has too.
_SHORT_WORDS = {
    "LengthUnit": {"m": "metre", "cm": "centimetre", "mm": "millimetre", "in": "inch"},
    "FitMode": {"best": "best_fit"},
}
# Enums of which 0 means "found from the mesh".
_FOUND_BY_DEFAULT = ("LengthUnit", "UpAxis", "MeshFileFormat")


def nearest(word: str, known: Iterable[str]) -> str:
    """'; did you mean 'tight'?" where something known is near, or has the word in it ("fit" in
    "fit_mode"); else nothing."""
    names = sorted(known)
    near = difflib.get_close_matches(word, names, n=1)
    near += [name for name in names if word in name.split("_")]
    return f"; did you mean {near[0]!r}?" if near else ""


def word_of(enum: Any, number: int) -> Optional[str]:
    """The word of a value of an enum's descriptor: None for 0, the number of an unknown one."""
    if number == 0:
        return None
    value = enum.values_by_number.get(number)
    return str(number) if value is None else _word(enum, value.name)


def number_of(enum: Any, name: str, word: str) -> int:
    """The way back, for the option `name`. ValueError lists the words and names the nearest."""
    numbers: Dict[str, int] = {
        _word(enum, value.name): value.number for value in enum.values if value.number
    }
    if enum.name in _FOUND_BY_DEFAULT:
        numbers["auto"] = 0
    short = _SHORT_WORDS.get(enum.name, {})
    plain = word.lower().replace("-", "_")
    plain = short.get(plain, plain)
    if plain not in numbers:
        near = nearest(plain, [*numbers, *short])
        raise ValueError(f"{name} is {word!r}, must be one of {', '.join(numbers)}{near}")
    return numbers[plain]


def message_document(message: Any) -> Dict[str, Any]:
    """All fields of a message as in result.json: a Vector3 as [x, y, z], enums as words, and only
    those optional fields that are set."""
    return {
        field.name: _value(field, getattr(message, field.name))
        for field in message.DESCRIPTOR.fields
        if not _is_left_out(message, field)
    }


def _is_left_out(message: Any, field: Any) -> bool:
    is_optional = field.containing_oneof is not None and len(field.containing_oneof.fields) == 1
    return is_optional and not message.HasField(field.name)


def _value(field: Any, value: Any) -> Any:
    is_list = hasattr(value, "__len__") and not isinstance(value, (str, bytes))
    return [_single(field, one) for one in value] if is_list else _single(field, value)


def _single(field: Any, value: Any) -> Any:
    if field.enum_type is not None:
        return word_of(field.enum_type, value)
    if field.message_type is None:
        return value
    if field.message_type.name == "Vector3":
        return [value.x, value.y, value.z]
    return message_document(value)


def _word(enum: Any, name: str) -> str:
    prefix = re.sub(r"(?<=.)(?=[A-Z])", "_", enum.name).upper() + "_"
    return (name[len(prefix):] if name.startswith(prefix) else name).lower()
