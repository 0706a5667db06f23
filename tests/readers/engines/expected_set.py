"""What programs must find in the files beside expected.json; metres, Y up."""
import json
import math
import os

TOLERANCE = 1e-6


def load(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return json.load(file)


def warnings(folder, name):
    return load(folder, "warnings.json")[name]


def read(folder):
    """Spheres (name, center, radius, joint), capsules (pairs), joints (name, parent, to_upright: three
    rows of four) and solids (name, joint, capsule, ends: one sphere or two)."""
    root = load(folder, "expected.json")
    rows, scale = root["upright_from_mesh"], root["metres_per_unit"]

    def upright(point):
        return [sum(r[k] * point[k] for k in range(3)) + r[3] for r in rows]

    spheres = [dict(s, center=upright(s["center"]), radius=scale * s["radius"])
               for s in root["spheres"]]
    joints = []
    for joint in root["joints"]:
        columns = list(zip(*joint["to_mesh"]))
        turned = [[sum(r[k] * c[k] for k in range(3)) for c in columns[:3]] for r in rows]
        origin = upright(columns[3])
        joints.append(dict(joint, to_upright=[t + [o] for t, o in zip(turned, origin)]))
    solids = []
    for index, capsule in enumerate(root["capsules"]):
        ends = [spheres[i] for i in capsule["spheres"]]
        difference = abs(ends[0]["radius"] - ends[1]["radius"])
        if math.dist(ends[0]["center"], ends[1]["center"]) <= difference:
            ends = [max(ends, key=lambda end: end["radius"])]
        solids.append({"name": capsule["name"], "joint": capsule["joint"], "capsule": index,
                       "ends": ends})
    for sphere in spheres:
        if sphere["lone"]:
            solids.append({"name": sphere["name"], "joint": sphere["joint"], "capsule": None,
                           "ends": [sphere]})
    return {"spheres": spheres, "capsules": [c["spheres"] for c in root["capsules"]],
            "joints": joints, "solids": solids}


def near(values, wanted, what, tolerance=TOLERANCE):
    for value, want in zip(values, wanted, strict=True):
        assert abs(value - want) <= tolerance, f"{what}: {values} for {wanted}"


def compare_spheres(expected, spheres):
    """Lists of x, y, z, radius."""
    assert len(spheres) == len(expected["spheres"]), "the number of spheres"
    for sphere, want in zip(spheres, expected["spheres"]):
        near(sphere, want["center"] + [want["radius"]], want["name"])
