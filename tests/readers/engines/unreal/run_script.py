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
    return expected_set.rotate([q.x, q.y, q.z, q.w], v)


def times(a, b):
    """The turn b, then the turn a; x, y, z, w."""
    u, v = a[:3], b[:3]
    return [a[3] * y + b[3] * x + z for x, y, z in zip(u, v, expected_set.cross(u, v))] + [
        a[3] * b[3] - sum(x * y for x, y in zip(u, v))]


def moved(transform, joint, quarters):
    """The bone after its joint has moved in the pose, as animation moves it. (Seen in a mirror a turn goes the other way.)"""
    shift, turn = joint["moved_upright"]["position"], joint["moved_upright"]["rotation"]
    axis = quarter_turned([-turn[0], -turn[2], -turn[1]], quarters)
    turn = editor.Quat(*axis, turn[3])
    place = transform.translation
    spot = rotate(turn, [place.x, place.y, place.z])
    away = quarter_turned(unreal_point(shift), quarters)
    old = transform.rotation
    return editor.Transform(
        editor.Vector(*(a + b for a, b in zip(spot, away))),
        editor.Quat(*times(axis + [turn.w], [old.x, old.y, old.z, old.w])), transform.scale3d)


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


def compare(element, bone, solid, quarters):
    ends = ends_of(element, bone)
    assert len(ends) == len(solid["ends"]), solid["name"]
    for end, want in zip(ends, solid["ends"]):
        center = quarter_turned(unreal_point(want["center"]), quarters)
        expected_set.near(end, center + [100.0 * want["radius"]], solid["name"], TOLERANCE_CM)


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
                found[name] = (bone, element)
    assert len(found) == len(expected["solids"]), "the number of shapes"
    for solid in expected["solids"]:
        bone, element = found[solid["name"]]
        compare(element, bones[bone], solid, quarters)
        if solid["joint"] < 0:
            continue
        carrier = names[solid["joint"]]
        while carrier not in bodies:
            carrier = parents[carrier]
        assert bone == carrier, f"{solid['name']} hangs on {bone}, not {carrier}"
    for solid in expected_set.read(folder, is_posed=True)["solids"]:
        bone, element = found[solid["name"]]
        # What hangs on a bone above its own, or on another of the same name, moves with that.
        if solid["joint"] >= 0 and bone == names[solid["joint"]] and names.count(bone) == 1:
            joint = expected["joints"][solid["joint"]]
            compare(element, moved(bones[bone], joint, quarters), solid, quarters)
    return len(found)


folder = sys.argv[1]
joints = expected_set.read(folder)["joints"]
count = run(folder, 0, set())
run(folder, 3 if joints else 0, {plain(joint["name"]) for joint in joints[1::2]})
print(f"ok: {os.path.basename(folder)}: {count} shapes in the stand-in for Unreal")
