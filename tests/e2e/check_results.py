#!/usr/bin/python3
"""Whether result files keep to docs/result.schema.json, and whether the schema would notice if not.

    check_results.py SCHEMA RESULT...

Exit code 0: they do. 77: Debian's python3-jsonschema is missing.
"""

import copy
import json
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("SKIPPED: python3-jsonschema is missing; deploy/install_packages.sh test installs it")
    sys.exit(77)


def closed(schema):
    """The same schema, but members that it does not describe are refused."""
    if isinstance(schema, list):
        return [closed(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    strict = {name: closed(value) for name, value in schema.items()}
    if strict.get("additionalProperties") is True:
        strict["additionalProperties"] = False
    return strict


def check_described(schema, path="schema"):
    """Every member says what it is, every number in which unit, every object whether it may grow."""
    for name, member in schema.get("properties", {}).items():
        here = f"{path}.{name}"
        assert member.get("description"), f"{here} has no description"
        if "$ref" not in member:
            check_described(member, here)
    kinds = schema.get("type", [])
    if {"number", "integer"} & set([kinds] if isinstance(kinds, str) else kinds):
        assert schema.get("unit"), f"{path} has no unit"
    if kinds == "object" and "propertyNames" not in schema:
        assert "additionalProperties" in schema, f"{path} does not say whether it may grow"
    if isinstance(schema.get("items"), dict) and not schema.get("unit"):
        check_described(schema["items"], path + "[]")
    if isinstance(schema.get("additionalProperties"), dict):
        check_described(schema["additionalProperties"], path + ".*")


def check_consistent(result):
    """What a schema cannot say."""
    spheres, capsules = len(result["spheres"]), len(result["capsules"])
    for name in ("sphere_names", "sphere_parts", "sphere_mirrors"):
        assert len(result[name]) == spheres, name
    assert len(result["capsule_parts"]) == capsules
    for first, second in result["capsules"]:
        assert 0 <= first < second < spheres
    mirrors = result["sphere_mirrors"]
    for index, mirror in enumerate(mirrors):
        assert mirror is None or mirrors[mirror] == index, f"sphere_mirrors[{index}]"
    polygons = result.get("feature_polygons")
    assert (polygons is not None) == result["options"]["want_feature_polygons"]
    assert (polygons is not None) == ("sphere_polygons" in result)
    for index in result.get("sphere_polygons", []):
        assert index is None or 0 <= index < len(polygons)
    assert result["metrics"]["primitive_count"] == spheres + capsules
    assert result["metrics"]["sphere_count"] == spheres
    assert result["unit"] == result["options"]["unit"]
    assert result["up_axis"] == result["options"]["up_axis"]
    assert result["metres_per_unit"] == result["body_from_caller"]["scale"]
    low, high = result["body"]["box_min"], result["body"]["box_max"]
    assert all(a < b for a, b in zip(low, high))


def check_notices(schema, loose, strict, result):
    """Every required member is missed, and what a later version adds is let pass."""
    for name in schema["required"]:
        lacking = {key: value for key, value in result.items() if key != name}
        assert not loose.is_valid(lacking), f"{name} is not missed"
        assert not loose.is_valid({**result, name: {"no": "such thing"}}), f"{name} may be anything"
    for place in ("metrics", "options", "body", "body_from_caller"):
        for name in schema["properties"][place]["required"]:
            lacking = copy.deepcopy(result)
            del lacking[place][name]
            assert not loose.is_valid(lacking), f"{place}.{name} is not missed"
    later = {**result, "tomorrow": 1}
    assert loose.is_valid(later) and not strict.is_valid(later)


def main(schema_path, *result_paths):
    with open(schema_path, encoding="utf-8") as file:
        schema = json.load(file)
    Draft202012Validator.check_schema(schema)
    check_described(schema)
    for name, definition in schema["$defs"].items():
        check_described(definition, name)
    loose, strict = Draft202012Validator(schema), Draft202012Validator(closed(schema))
    wrong = 0
    for path in result_paths:
        with open(path, encoding="utf-8") as file:
            result = json.load(file)
        for error in strict.iter_errors(result):
            place = ".".join(map(str, error.absolute_path))
            print(f"{path}: {place or 'the whole'}: {error.message[:300]}")
            wrong += 1
        if not wrong:
            check_consistent(result)
            check_notices(schema, loose, strict, result)
    sys.exit(1 if wrong or not result_paths else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
