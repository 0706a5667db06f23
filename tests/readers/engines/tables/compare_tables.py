"""Compares spheres.csv and capsules.csv with the result: compare_tables.py FOLDER."""
import csv
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
import expected_set  # noqa: E402


def rows_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8", newline="") as file:
        text = file.read()
    lines = text.split("\n")
    comments = 0
    while lines[comments].startswith("# "):
        comments += 1
    assert comments == 7 and lines[4].startswith("# frame: metres, +Y up"), "what the file says"
    return list(csv.DictReader("\n".join(lines[comments:]).splitlines(keepends=True)))


folder = sys.argv[1]
expected = expected_set.read(folder)
spheres = rows_of(folder, "spheres.csv")
expected_set.compare_spheres(
    expected, [[float(row[key]) for key in ("x_m", "y_m", "z_m", "radius_m")] for row in spheres])
for row, want in zip(spheres, expected["spheres"]):
    assert row["name"] == want["name"] and bool(int(row["is_lone"])) == want["lone"], row
expected_set.compare_offsets(folder, [
    [want["joint"], *(float(row[key]) for key in ("joint_x_m", "joint_y_m", "joint_z_m"))]
    for row, want in zip(spheres, expected["spheres"])])
capsules = rows_of(folder, "capsules.csv")
assert [[int(r["first_sphere"]), int(r["second_sphere"])] for r in capsules] == expected["capsules"]
for row, solid in zip(capsules, expected["solids"]):
    assert row["name"] == solid["name"], row
    assert bool(int(row["is_sphere"])) == (len(solid["ends"]) == 1), row
    ends = [expected["spheres"][i] for i in expected["capsules"][int(row["index"])]]
    expected_set.near([float(row["first_radius_m"]), float(row["second_radius_m"])],
                      [end["radius"] for end in ends], row["name"])
print(f"ok: {os.path.basename(folder)}: {len(spheres)} spheres and {len(capsules)} capsules in tables")
