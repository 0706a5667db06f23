"""A stand-in for Unreal's Python module: skeletal meshes with bones, physics assets with bodies, and the
few calls that unreal_physics_asset.py makes. Left-handed, Z up, centimetres, as the editor is."""
import math
import types


class Vector:
    def __init__(self, x=0.0, y=0.0, z=0.0):
        self.x, self.y, self.z = float(x), float(y), float(z)


class Quat:
    def __init__(self, x, y, z, w):
        self.x, self.y, self.z, self.w = x, y, z, w


class Rotator:
    def __init__(self, roll=0.0, pitch=0.0, yaw=0.0):
        self.roll, self.pitch, self.yaw = roll, pitch, yaw

    def z_axis(self):
        """The third row of the engine's rotation matrix: where +Z goes."""
        (sr, cr), (sp, cp), (sy, cy) = (
            (math.sin(math.radians(a)), math.cos(math.radians(a)))
            for a in (self.roll, self.pitch, self.yaw))
        return [-(cr * sp * cy + sr * sy), cy * sr - cr * sp * sy, cr * cp]


class Transform:
    def __init__(self, translation, rotation, scale3d):
        self.translation, self.rotation, self.scale3d = translation, rotation, scale3d


class Object:
    """Properties as the editor has them: unknown names and wrong types are errors."""
    PROPERTIES = {}

    def __init__(self):
        self.values = {name: None for name in self.PROPERTIES}

    def set_editor_property(self, name, value):
        kind = self.PROPERTIES[name]
        if kind is float:
            value = float(value)
        assert value is None or isinstance(value, kind), (type(self).__name__, name, value)
        self.values[name] = value

    def get_editor_property(self, name):
        return self.values[name]


class KSphereElem(Object):
    PROPERTIES = {"name": str, "center": Vector, "radius": float}


class KTaperedCapsuleElem(Object):
    PROPERTIES = {"name": str, "center": Vector, "rotation": Rotator, "radius0": float,
                  "radius1": float, "length": float}


class KAggregateGeom(Object):
    PROPERTIES = {"sphere_elems": list, "tapered_capsule_elems": list}


class SkeletalBodySetup(Object):
    PROPERTIES = {"bone_name": str, "agg_geom": KAggregateGeom}


class PhysicsAsset(Object):
    def __init__(self, path, setups):
        super().__init__()
        self.path, self.setups = path, setups

    def get_path_name(self):
        return self.path


class SkeletalMesh(Object):
    PROPERTIES = {"physics_asset": PhysicsAsset}

    def __init__(self, bones, parents):
        super().__init__()
        self.bones, self.parents = bones, parents  # Transform by name; parent by name


class SkeletalMeshActor:
    pass


def make(mesh, bodies):
    """The module for an editor in which `mesh` is selected and a new physics asset gets `bodies`."""
    log = []

    def setup_of(bone):
        setup = SkeletalBodySetup()
        setup.set_editor_property("bone_name", bone)
        return setup

    setups = [setup_of(bone) for bone in bodies]
    # The engine's numbers have gaps.
    asset = PhysicsAsset("/Game/Body_PhysicsAsset.Body_PhysicsAsset",
                         {3 * i + 1: setup for i, setup in enumerate(setups)})

    class Component:
        def set_skeletal_mesh_asset(self, chosen):
            assert chosen is mesh
            self.names = list(mesh.bones)

        def get_num_bones(self):
            return len(self.names)

        def get_bone_name(self, index):
            return self.names[index]

        def get_parent_bone(self, name):
            return mesh.parents.get(name) or "None"

        def get_socket_transform(self, name, space):
            assert space == "component"
            return mesh.bones[name]

    class Actors:
        living = 0

        def spawn_actor_from_class(self, kind, location):
            assert kind is SkeletalMeshActor and isinstance(location, Vector)
            Actors.living += 1
            return types.SimpleNamespace(skeletal_mesh_component=Component())

        def destroy_actor(self, actor):
            Actors.living -= 1

    class MeshEditor:
        def create_physics_asset(self, chosen):
            assert chosen is mesh
            return asset

    def load_object(outer, path):
        start = asset.path + ":SkeletalBodySetup_"
        assert path.startswith(start)
        return asset.setups.get(int(path[len(start):]))

    module = types.ModuleType("unreal")
    for kind in (Vector, Rotator, KSphereElem, KTaperedCapsuleElem, KAggregateGeom, SkeletalMesh,
                 SkeletalMeshActor):
        setattr(module, kind.__name__, kind)
    module.EditorActorSubsystem, module.SkeletalMeshEditorSubsystem = Actors, MeshEditor
    module.get_editor_subsystem = lambda kind: kind()
    module.RelativeTransformSpace = types.SimpleNamespace(RTS_COMPONENT="component")
    module.EditorUtilityLibrary = types.SimpleNamespace(get_selected_assets=lambda: [mesh])
    saved = []
    module.EditorAssetLibrary = types.SimpleNamespace(
        save_loaded_asset=lambda chosen, only_if_is_dirty: saved.append(chosen))
    module.load_object = load_object
    module.log, module.log_warning = log.append, log.append
    return types.SimpleNamespace(module=module, asset=asset, setups=setups, saved=saved,
                                 actors=Actors, log=log)
