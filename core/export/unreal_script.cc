#include "core/export/unreal_script.h"

namespace capfit::exports {

std::string_view UnrealScript() {
  return R"python(
import math
import re
import sys

import unreal

# Path of the skeletal mesh, e.g. "/Game/Characters/SK_Woman"; empty: the first argument of the
# command, else the skeletal mesh selected in the content browser.
SKELETAL_MESH = ""
# A bone may stand this far from where it stood when the body was fitted.
TOLERANCE_CM = 1.0


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def rotate(quaternion, v):
    """The vector turned by the quaternion (x, y, z, w)."""
    axis, w = quaternion[:3], quaternion[3]
    twice = [2.0 * x for x in cross(axis, v)]
    return add(add(v, [w * x for x in twice]), cross(axis, twice))


def turn_about_z(quarters, v):
    cosine, sine = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters]
    return [cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1], v[2]]


class Bone:
    """A bone of the skeletal mesh in its reference pose, in the component's space."""

    def __init__(self, transform):
        t, r, s = transform.translation, transform.rotation, transform.scale3d
        self.position = [t.x, t.y, t.z]
        self.inverse = [-r.x, -r.y, -r.z, r.w]
        self.scale = [s.x, s.y, s.z]

    def local_point(self, point):
        turned = rotate(self.inverse, subtract(point, self.position))
        return [x / s for x, s in zip(turned, self.scale)]

    def local_direction(self, direction):
        return rotate(self.inverse, direction)

    def local_length(self, length):
        return length / max(abs(s) for s in self.scale)


def chosen_mesh():
    path = SKELETAL_MESH or (sys.argv[1] if len(sys.argv) > 1 else "")
    if path:
        mesh = unreal.load_asset(path)
    else:
        selected = unreal.EditorUtilityLibrary.get_selected_assets()
        mesh = next((a for a in selected if isinstance(a, unreal.SkeletalMesh)), None)
    if not isinstance(mesh, unreal.SkeletalMesh):
        raise RuntimeError("capfit: no skeletal mesh: set SKELETAL_MESH, or select one")
    return mesh


def reference_bones(mesh):
    """Of each bone its Bone and the name of its parent, from an actor that is removed again."""
    actors = unreal.get_editor_subsystem(unreal.EditorActorSubsystem)
    actor = actors.spawn_actor_from_class(unreal.SkeletalMeshActor, unreal.Vector(0, 0, 0))
    try:
        component = actor.skeletal_mesh_component
        component.set_skeletal_mesh_asset(mesh)
        bones, parents = {}, {}
        for index in range(component.get_num_bones()):
            name = str(component.get_bone_name(index))
            bones[name] = Bone(component.get_socket_transform(
                name, unreal.RelativeTransformSpace.RTS_COMPONENT))
            parents[name] = str(component.get_parent_bone(name))
        return bones, parents
    finally:
        actors.destroy_actor(actor)


def take_names_of(bones):
    """Importers write some characters of bones' names otherwise: DATA gets the names as they are."""
    def plain(name):
        return re.sub(r"[^0-9a-z]", "_", name.lower())

    known = {plain(name): name for name in bones}
    for bone in DATA["bones"]:
        if bone["name"] not in bones:
            bone["name"] = known.get(plain(bone["name"]), bone["name"])


def quarter_turns(bones):
    """By how many quarter turns about Z the importer stood the body otherwise."""
    names = [b["name"] for b in DATA["bones"]]
    known = [b for b in DATA["bones"] if b["name"] in bones and names.count(b["name"]) == 1]
    if not known:
        if DATA["bones"]:
            raise RuntimeError("capfit: the skeletal mesh has no bone of the fitted rig")
        return 0

    def error(quarters):
        return max(math.dist(turn_about_z(quarters, b["position"]), bones[b["name"]].position)
                   for b in known)

    best = min(range(4), key=error)
    if error(best) > TOLERANCE_CM:
        raise RuntimeError(
            "capfit: bones stand up to %.1f cm from where they stood when the body was fitted: "
            "another pose, unit or rig" % error(best))
    return best


def body_setups(asset):
    """The bodies of a physics asset by bone. Python does not see the list itself; the bodies are
    objects inside of the asset, numbered by the engine, with gaps where some were deleted."""
    setups, missed, index = {}, 0, 0
    while missed < 64:
        setup = unreal.load_object(
            None, "%s:SkeletalBodySetup_%d" % (asset.get_path_name(), index))
        index += 1
        missed = missed + 1 if setup is None else 0
        if setup is not None:
            setups[str(setup.get_editor_property("bone_name"))] = setup
    return setups


def rotator_of_z(direction):
    """The rotator that takes +Z to the direction; pitch within 90 degrees."""
    x, y, z = direction
    across = math.hypot(x, y)
    if z >= 0.0:
        yaw = math.atan2(-y, -x) if across > 0.0 else 0.0
        pitch, roll = math.atan2(across, z), 0.0
    else:
        yaw = math.atan2(y, x) if across > 0.0 else 0.0
        pitch, roll = math.atan2(across, -z), math.pi
    return unreal.Rotator(
        pitch=math.degrees(pitch), yaw=math.degrees(yaw), roll=math.degrees(roll))


def element_of(shape, bone, quarters):
    element = unreal.KTaperedCapsuleElem() if shape["kind"] == "tapered" else unreal.KSphereElem()
    center = bone.local_point(turn_about_z(quarters, shape["center"]))
    element.set_editor_property("center", unreal.Vector(*center))
    element.set_editor_property("name", shape["name"])
    if shape["kind"] == "sphere":
        element.set_editor_property("radius", bone.local_length(shape["radius"]))
        return element
    axis = bone.local_direction(turn_about_z(quarters, shape["axis"]))
    element.set_editor_property("rotation", rotator_of_z(axis))
    for key in ("radius0", "radius1", "length"):
        element.set_editor_property(key, bone.local_length(shape[key]))
    return element


def carrier_of(shape, setups, bones, parents):
    """The bone that carries the shape, or the nearest above it that has a body."""
    roots = [name for name in bones if parents[name] not in bones]
    wanted = DATA["bones"][shape["bone"]]["name"] if shape["bone"] >= 0 else roots[0]
    name = wanted
    while name not in setups and parents.get(name) in bones:
        name = parents[name]
    if name not in setups:
        raise RuntimeError("capfit: no body on bone '%s' or above it: add one in the physics "
                           "asset editor and run this again" % wanted)
    if name != wanted:
        unreal.log_warning("capfit: no body on bone '%s': '%s' hangs on '%s'"
                           % (wanted, shape["name"], name))
    return name


def main():
    mesh = chosen_mesh()
    asset = mesh.get_editor_property("physics_asset")
    if asset is None:
        editor = unreal.get_editor_subsystem(unreal.SkeletalMeshEditorSubsystem)
        asset = editor.create_physics_asset(mesh)
        mesh.set_editor_property("physics_asset", asset)
    bones, parents = reference_bones(mesh)
    take_names_of(bones)
    quarters = quarter_turns(bones)
    setups = body_setups(asset)
    elements = {name: ([], []) for name in setups}
    for shape in DATA["shapes"]:
        name = carrier_of(shape, setups, bones, parents)
        elements[name][shape["kind"] == "sphere"].append(element_of(shape, bones[name], quarters))
    for name, (tapered, spheres) in elements.items():
        geometry = unreal.KAggregateGeom()
        geometry.set_editor_property("tapered_capsule_elems", tapered)
        geometry.set_editor_property("sphere_elems", spheres)
        setups[name].set_editor_property("agg_geom", geometry)
    unreal.EditorAssetLibrary.save_loaded_asset(asset, only_if_is_dirty=False)
    unreal.EditorAssetLibrary.save_loaded_asset(mesh, only_if_is_dirty=False)
    unreal.log("capfit: %d shapes on %d bones of %s" % (
        len(DATA["shapes"]), sum(1 for e in elements.values() if any(e)), asset.get_path_name()))


main()
)python";
}

}  // namespace capfit::exports
