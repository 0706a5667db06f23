// A world of Jolt with the shapes of jolt_colliders.json as kinematic bodies.
import initJolt from 'jolt-physics';
import { compose, jointOf, rotate, scale, add } from './geometry.mjs';

export const Jolt = await initJolt();

const LAYER = 0;

export function makeWorld() {
  const settings = new Jolt.JoltSettings();
  const pairs = new Jolt.ObjectLayerPairFilterTable(1);
  pairs.EnableCollision(LAYER, LAYER);
  const layer = new Jolt.BroadPhaseLayer(0);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(LAYER, layer);
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter =
    new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  const jolt = new Jolt.JoltInterface(settings);
  Jolt.destroy(settings);
  const system = jolt.GetPhysicsSystem();
  return { jolt, system, bodies: system.GetBodyInterface(), layer: LAYER };
}

function settingsOf(shape) {
  if (shape.shape === 'Sphere') return new Jolt.SphereShapeSettings(shape.radius);
  return new Jolt.TaperedCapsuleShapeSettings(
    shape.half_height, shape.top_radius, shape.bottom_radius);
}

// The body of a shape, where its joint carries it. Throws what Jolt says is wrong.
export function addBody(world, file, shape) {
  const settings = settingsOf(shape);
  const result = settings.Create();
  if (result.HasError()) throw new Error(`${shape.name}: ${result.GetError().c_str()}`);
  const place = compose(jointOf(file, shape.joint),
    { position: shape.joint_position, rotation: shape.joint_rotation });
  const creation = new Jolt.BodyCreationSettings(result.Get(), new Jolt.RVec3(...place.position),
    new Jolt.Quat(...place.rotation).Normalized(), Jolt.EMotionType_Kinematic, world.layer);
  creation.mFriction = 1;
  const body = world.bodies.CreateBody(creation);
  Jolt.destroy(creation);
  world.bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
  return { body, id: body.GetID(), place };
}

// Moves a kinematic body to a frame in one step of `seconds`.
export function moveBody(world, id, { position, rotation }, seconds) {
  world.bodies.MoveKinematic(id, new Jolt.RVec3(...position),
    new Jolt.Quat(...rotation).Normalized(), seconds);
}

// The spheres that Jolt has for a body: bottom and top, or one.
export function spheresOf(body) {
  const shape = body.GetShape();
  const position = body.GetPosition();
  const rotation = body.GetRotation();
  const p = [position.GetX(), position.GetY(), position.GetZ()];
  const q = [rotation.GetX(), rotation.GetY(), rotation.GetZ(), rotation.GetW()];
  if (shape.GetSubType() === Jolt.EShapeSubType_Sphere) {
    return [{ center: p, radius: Jolt.castObject(shape, Jolt.SphereShape).GetRadius() }];
  }
  if (shape.GetSubType() !== Jolt.EShapeSubType_TaperedCapsule) {
    throw new Error(`a body of sub type ${shape.GetSubType()}`);
  }
  const capsule = Jolt.castObject(shape, Jolt.TaperedCapsuleShape);
  const up = scale(rotate(q, [0, 1, 0]), capsule.GetHalfHeight());
  return [{ center: add(p, scale(up, -1)), radius: capsule.GetBottomRadius() },
    { center: add(p, up), radius: capsule.GetTopRadius() }];
}
