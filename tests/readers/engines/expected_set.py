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


def read(folder, is_posed=False):
    """Spheres (name, center, radius, joint), capsules (pairs), joints (name, parent, to_upright: three
    rows of four, moved_upright) and solids (name, joint, capsule, ends: one sphere or two); at rest or
    where `animate --one-joint` has them in the pose."""
    root = load(folder, "expected.json")
    rows, scale = root["upright_from_mesh"], root["metres_per_unit"]

    def upright(point):
        return [sum(r[k] * point[k] for k in range(3)) + r[3] for r in rows]

    where = "posed_center" if is_posed else "center"
    spheres = [dict(s, center=upright(s[where]), radius=scale * s["radius"])
               for s in root["spheres"]]
    joints = []
    for joint in root["joints"]:
        columns = list(zip(*joint["posed" if is_posed else "to_mesh"]))
        turned = [[sum(r[k] * c[k] for k in range(3)) for c in columns[:3]] for r in rows]
        origin = upright(columns[3])
        joints.append(dict(joint, to_upright=[t + [o] for t, o in zip(turned, origin)]))
    solids = []
    for index, capsule in enumerate(root["capsules"]):
        ends = [spheres[i] for i in capsule["spheres"]]
        if is_posed:
            ends = [dict(end, center=upright(place))
                    for end, place in zip(ends, capsule["posed_centers"])]
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


def rotate(q, v):
    """A point turned by a quaternion x, y, z, w."""
    twice = [2.0 * x for x in cross(q[:3], v)]
    return [a + q[3] * b + c for a, b, c in zip(v, twice, cross(q[:3], twice))]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def placed(frame, point):
    """A point of a frame {position, rotation} where the frame is seen."""
    return [a + b for a, b in zip(frame["position"], rotate(frame["rotation"], point))]


def compare_offsets(folder, offsets):
    """Lists of joint, x, y, z in the joint's frame, which is that of jolt_colliders.json: the centres at
    rest and posed."""
    frames = load(folder, "jolt_colliders.json")["joints"]
    rest, posed = read(folder), read(folder, is_posed=True)
    assert len(offsets) == len(rest["spheres"])
    for (joint, *offset), sphere, moved in zip(offsets, rest["spheres"], posed["spheres"]):
        assert joint == sphere["joint"], f"{sphere['name']} hangs on {joint}"
        center = placed(frames[joint], offset) if joint >= 0 else offset
        near(center, sphere["center"], sphere["name"])
        if joint >= 0:
            center = placed(rest["joints"][joint]["moved_upright"], center)
        near(center, moved["center"], sphere["name"] + ", posed")


def compare_spheres(expected, spheres):
    """Lists of x, y, z, radius."""
    assert len(spheres) == len(expected["spheres"]), "the number of spheres"
    for sphere, want in zip(spheres, expected["spheres"]):
        near(sphere, want["center"] + [want["radius"]], want["name"])
