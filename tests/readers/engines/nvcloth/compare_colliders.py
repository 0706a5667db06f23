"""Compares what print_colliders.c said with the result: compare_colliders.py FOLDER PRINTED."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
import expected_set  # noqa: E402

folder, printed = sys.argv[1:]
expected = expected_set.read(folder)
with open(printed, encoding="ascii") as file:
    lines = [line.split(" ") for line in file.read().splitlines()]
spheres = [[float(x) for x in line[1:]] for line in lines if line[0] == "s"]
capsules = [[int(x) for x in line[1:]] for line in lines if line[0] == "c"]
expected_set.compare_spheres(expected, spheres)
assert capsules == expected["capsules"], "other capsules"
names = [bytes.fromhex(line[1]).decode("utf-8") for line in lines if line[0] == "n"]
assert names == [j["name"] for j in expected_set.load(folder, "jolt_colliders.json")["joints"]]
expected_set.compare_offsets(folder, [[int(line[1]), *(float(x) for x in line[2:])]
                                      for line in lines if line[0] == "o"])
warnings = {w["code"] for w in expected_set.warnings(folder, "nvcloth")}
too_many = len(spheres) > 32 or len(capsules) > 32
assert too_many == ("COLLIDER_LIMIT" in warnings), "the limit of 32"
inner = sum(len(solid["ends"]) == 1 for solid in expected["solids"] if solid["capsule"] is not None)
assert (inner > 0) == ("INNER_SPHERES" in warnings), "skipped capsules"
print(f"ok: {os.path.basename(folder)}: {len(spheres)} spheres, {len(capsules)} capsules in C and C++")
