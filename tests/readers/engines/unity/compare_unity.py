"""compare_unity.py bones FOLDER: the bones as a glTF importer for Unity puts them, at rest and posed, as
JSON.
compare_unity.py compare FOLDER MADE: unity_colliders.json, and what MakeColliders.cs said of the colliders
that the component made of it, against the result."""
import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
import expected_set  # noqa: E402

FLOAT_TOLERANCE = 5e-5  # Unity reckons in floats, through a chain of bones up to a finger's


def unity(p):
    return [-p[0], p[1], p[2]]


def vector(p):
    return {"x": p[0], "y": p[1], "z": p[2]}


def numbers(v):
    return [v["x"], v["y"], v["z"]]


def quaternion(m):
    """Of a rotation matrix; the largest component from the diagonal."""
    squares = [1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
               1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]]
    largest = squares.index(max(squares))
    s = 2.0 * math.sqrt(squares[largest])
    sums = {"xy": m[0][1] + m[1][0], "yz": m[1][2] + m[2][1], "xz": m[0][2] + m[2][0]}
    w = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]]
    x, y, z, q = {
        0: (s * s / 4, sums["xy"], sums["xz"], w[0]), 1: (sums["xy"], s * s / 4, sums["yz"], w[1]),
        2: (sums["xz"], sums["yz"], s * s / 4, w[2]), 3: (w[0], w[1], w[2], s * s / 4)}[largest]
    return {"x": x / s, "y": y / s, "z": z / s, "w": q / s}


def bone_place(joint):
    """In the frame that has x turned about, as its importers turn every node."""
    rows = [row[:3] for row in joint["to_upright"]]
    flip = [-1.0, 1.0, 1.0]
    flipped = [[flip[r] * flip[c] * rows[r][c] for c in range(3)] for r in range(3)]
    scale = math.sqrt(sum(x * x for row in flipped for x in row) / 3.0)
    return {"name": joint["name"], "parent": joint["parent"],
            "position": vector(unity([row[3] for row in joint["to_upright"]])),
            "rotation": quaternion([[x / scale for x in row] for row in flipped]), "scale": scale}


def compare_file(folder, expected):
    root = expected_set.load(folder, "unity_colliders.json")
    assert root["format"] == "capfit-unity" and "left-handed" in root["frame"]
    expected_set.compare_spheres(
        expected, [unity(numbers(s["position"])) + [s["radius"]] for s in root["spheres"]])
    for sphere, want in zip(root["spheres"], expected["spheres"]):
        if want["joint"] < 0:
            continue
        rows = expected["joints"][want["joint"]]["to_upright"]
        local = unity(numbers(sphere["bonePosition"]))
        back = [sum(row[k] * local[k] for k in range(3)) + row[3] for row in rows]
        expected_set.near(back, want["center"], sphere["name"])
    assert [[p["first"], p["second"]] for p in root["pairs"]] == expected["capsules"]
    lone = [i for i, s in enumerate(expected["spheres"]) if s["lone"]]
    assert root["loneSpheres"] == lone
    warned = {w["code"] for w in expected_set.warnings(folder, "unity")}
    assert ("COLLIDER_LIMIT" in warned) == (len(root["spheres"]) > 32 or len(root["pairs"]) > 32)


def made_ends(words):
    values = [float(x) for x in words]
    return [values[k:k + 4] for k in range(0, len(values), 4)]


def compare_made(made, expected, placement):
    lines = [line.split() for line in made if line.split()[1] == placement]

    def of(kind, prefix):
        named = [(bytes.fromhex(w[2]).decode("utf-8"), w[3:]) for w in lines if w[0] == kind]
        assert all(name.startswith(prefix) for name, _ in named)
        return {name[len(prefix):]: rest for name, rest in named}

    spheres = {name: made_ends(rest) for name, rest in of("sphere", "capfit_").items()}
    wanted = {s["name"]: [s] for s in expected["spheres"]}
    solids = {s["name"]: s["ends"] for s in expected["solids"]}
    magica = {name: made_ends(rest) for kind in ("capsule", "ball")
              for name, rest in of(kind, "capfit_magica_").items()}
    for found, known in ((spheres, wanted), (magica, solids)):
        assert sorted(found) == sorted(known), f"{sorted(found)} for {sorted(known)}"
        for name, ends in known.items():
            assert len(found[name]) == len(ends), name
            for end, want in zip(found[name], ends):
                expected_set.near(end, unity(want["center"]) + [want["radius"]], name, FLOAT_TOLERANCE)
    names = [s["name"] for s in expected["spheres"]]
    pairs = [[names[a], names[b]] for a, b in expected["capsules"]]
    pairs += [[s["name"], None] for s in expected["spheres"] if s["lone"]]

    def sphere_name(word):
        return None if word == "-" else bytes.fromhex(word).decode("utf-8")[len("capfit_"):]

    assert [[sphere_name(w[2]), sphere_name(w[3])] for w in lines if w[0] == "pair"] == pairs
    return len(spheres)


mode, sample = sys.argv[1:3]
result = expected_set.read(sample)
if mode == "bones":
    posed = expected_set.read(sample, is_posed=True)
    json.dump({"bones": [bone_place(joint) for joint in result["joints"]],
               "posed": [bone_place(joint) for joint in posed["joints"]]}, sys.stdout)
else:
    compare_file(sample, result)
    with open(sys.argv[3], encoding="ascii") as printed:
        text = printed.readlines()
    count = compare_made(text, result, "ModelSpace")
    compare_made(text, result, "BoneLocal")
    compare_made(text, expected_set.read(sample, is_posed=True), "Posed")
    print(f"ok: {os.path.basename(sample)}: {count} spheres in the stand-in for Unity")
