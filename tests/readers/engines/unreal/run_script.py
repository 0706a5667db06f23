"""Runs the script of a folder in the stand-in editor and compares what it makes: run_script.py FOLDER."""
import ast
import os
import sys

sys.path[:0] = [os.path.dirname(__file__), os.path.join(os.path.dirname(__file__), "..")]
import editor  # noqa: E402
import expected_set  # noqa: E402

TOLERANCE_CM = 1e-4


def unreal_point(p):
    """From metres, Y up, right-handed."""
    return [100.0 * p[0], 100.0 * p[2], 100.0 * p[1]]


def quarter_turned(p, quarters):
    for _ in range(quarters):
        p = [-p[1], p[0], p[2]]
    return p


def bone_transform(index, joint, quarters):
    """Where the importer put the bone, in axes of its own and, for some, with a scale."""
    spot = quarter_turned(unreal_point([row[3] for row in joint["to_upright"]]), quarters)
    angle = 0.7 * index  # any turn: importers choose the bones' axes
    half = [0.6, -0.64, 0.48]
    sine, cosine = editor.math.sin(angle), editor.math.cos(angle)
    scale = 1.0 if index % 3 else 2.0
    return editor.Transform(editor.Vector(*spot),
                            editor.Quat(*(sine * x for x in half), cosine),
                            editor.Vector(scale, scale, scale))


def rotate(q, v):
    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    axis = [q.x, q.y, q.z]
    twice = [2.0 * x for x in cross(axis, v)]
    return [a + q.w * b + c for a, b, c in zip(v, twice, cross(axis, twice))]


def to_component(transform, point):
    turned = rotate(transform.rotation, [transform.scale3d.x * x for x in point])
    return [turned[0] + transform.translation.x, turned[1] + transform.translation.y,
            turned[2] + transform.translation.z]


def ends_of(element, transform):
    """The spheres of an element in the component's space: Radius0's, at +Z, first."""
    get, scale = element.get_editor_property, transform.scale3d.x
    center = [get("center").x, get("center").y, get("center").z]
    if isinstance(element, editor.KSphereElem):
        return [to_component(transform, center) + [scale * get("radius")]]
    half = [0.5 * get("length") * x for x in get("rotation").z_axis()]
    assert -90.0 <= get("rotation").pitch <= 90.0
    return [to_component(transform, [c + h for c, h in zip(center, half)]) + [scale * get("radius0")],
            to_component(transform, [c - h for c, h in zip(center, half)]) + [scale * get("radius1")]]


def plain(name):
    """An importer that writes some characters otherwise."""
    return name.replace(".", "_").replace(" ", "_")


def run(folder, quarters, missing_bodies):
    expected = expected_set.read(folder)
    names = [plain(joint["name"]) for joint in expected["joints"]]
    bones, parents = {}, {}
    for index, joint in enumerate(expected["joints"]):
        if names[index] in bones:
            continue  # the engine has each name once
        bones[names[index]] = bone_transform(index, joint, quarters)
        parents[names[index]] = names[joint["parent"]] if joint["parent"] >= 0 else None
    if not bones:
        bones["Root"] = editor.Transform(editor.Vector(), editor.Quat(0.0, 0.0, 0.0, 1.0),
                                         editor.Vector(1.0, 1.0, 1.0))
        parents["Root"] = None
    bodies = [bone for bone in bones if parents[bone] is None or bone not in missing_bodies]
    world = editor.make(editor.SkeletalMesh(bones, parents), bodies)
    with open(os.path.join(folder, "unreal_physics_asset.py"), encoding="ascii") as file:
        text = file.read()
    ast.parse(text)
    sys.modules["unreal"] = world.module
    sys.argv = ["unreal_physics_asset.py"]
    exec(compile(text, "unreal_physics_asset.py", "exec"), {"__name__": "__main__"})
    assert world.actors.living == 0 and world.asset in world.saved
    found = {}
    for setup in world.setups:
        bone, geometry = setup.get_editor_property("bone_name"), setup.get_editor_property("agg_geom")
        for key in ("tapered_capsule_elems", "sphere_elems"):
            for element in geometry.get_editor_property(key):
                name = element.get_editor_property("name")
                assert name not in found, f"{name} twice"
                found[name] = (bone, ends_of(element, bones[bone]))
    assert len(found) == len(expected["solids"]), "the number of shapes"
    for solid in expected["solids"]:
        bone, ends = found[solid["name"]]
        assert len(ends) == len(solid["ends"]), solid["name"]
        for end, want in zip(ends, solid["ends"]):
            center = quarter_turned(unreal_point(want["center"]), quarters)
            expected_set.near(end, center + [100.0 * want["radius"]], solid["name"], TOLERANCE_CM)
        if solid["joint"] >= 0:
            carrier = names[solid["joint"]]
            while carrier not in bodies:
                carrier = parents[carrier]
            assert bone == carrier, f"{solid['name']} hangs on {bone}, not {carrier}"
    return len(found)


folder = sys.argv[1]
joints = expected_set.read(folder)["joints"]
count = run(folder, 0, set())
run(folder, 3 if joints else 0, {plain(joint["name"]) for joint in joints[1::2]})
print(f"ok: {os.path.basename(folder)}: {count} shapes in the stand-in for Unreal")
