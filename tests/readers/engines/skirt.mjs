// A skirt of 8,000 vertices around the hips of a body, hung to be simulated by Jolt.
import { signedDistance } from '../gltf/files.mjs';
import { Jolt } from './jolt_world.mjs';

export const COLUMNS = 125;
export const ROWS = 64;
const LENGTH = 0.55; // metres from the waist to the hem
const GAP = 0.008; // at least, between the body and the skirt as it is sewn
const FLARE = 0.0015; // how much wider each row is than the one above
export const VERTEX_RADIUS = 0.006;
export const STEPS = 2;
const ITERATIONS = 5;
const VERTEX_MASS = 1.25e-4; // one kilogram in all

// Where a ray from the body's axis leaves the last of the solids.
function outerRadius(solids, center, height, angle) {
  const at = (r) =>
    [center[0] + r * Math.cos(angle), height, center[1] + r * Math.sin(angle)];
  const isInside = (p) => solids.some((s) => signedDistance(s.ends, p) < 0);
  const STEP = 0.002;
  let steps = 200;
  while (steps > 0 && !isInside(at(steps * STEP))) steps -= 1;
  return (steps + 1) * STEP;
}

// Rows of points from the waist down: each as far out as the body is there, and as the row above.
function sewnPoints(solids, center, waist) {
  const rows = [];
  for (let row = 0; row < ROWS; ++row) {
    const height = waist - (LENGTH * row) / (ROWS - 1);
    rows.push([]);
    for (let column = 0; column < COLUMNS; ++column) {
      const angle = (2 * Math.PI * column) / COLUMNS;
      const body = outerRadius(solids, center, height, angle) + GAP;
      const radius = row === 0 ? body : Math.max(body, rows[row - 1][column] + FLARE);
      rows[row].push(radius);
    }
  }
  return rows.flatMap((radii, row) => radii.map((radius, column) => {
    const angle = (2 * Math.PI * column) / COLUMNS;
    return [center[0] + radius * Math.cos(angle), waist - (LENGTH * row) / (ROWS - 1),
      center[1] + radius * Math.sin(angle)];
  }));
}

function faces() {
  const list = [];
  for (let row = 0; row + 1 < ROWS; ++row) {
    for (let column = 0; column < COLUMNS; ++column) {
      const a = row * COLUMNS + column;
      const b = row * COLUMNS + ((column + 1) % COLUMNS);
      list.push([a, b, a + COLUMNS], [b, b + COLUMNS, a + COLUMNS]);
    }
  }
  return list;
}
export const FACES = faces();

function sharedSettings(points) {
  const settings = new Jolt.SoftBodySharedSettings();
  points.forEach((p, i) => {
    const vertex = new Jolt.SoftBodySharedSettingsVertex();
    vertex.mPosition = new Jolt.Float3(...p);
    vertex.mInvMass = i < COLUMNS ? 0 : 1 / VERTEX_MASS; // the waist is pinned
    settings.mVertices.push_back(vertex);
    Jolt.destroy(vertex);
  });
  for (const corners of FACES) {
    const face = new Jolt.SoftBodySharedSettingsFace(...corners, 0);
    settings.AddFace(face);
    Jolt.destroy(face);
  }
  // Scaled with mass and step: a fixed small compliance is rigid for vertices as light as these,
  // and explodes.
  const step = 1 / 60 / STEPS / ITERATIONS;
  const attributes = new Jolt.SoftBodySharedSettingsVertexAttributes();
  attributes.mCompliance = 0.2 / VERTEX_MASS * step * step;
  attributes.mShearCompliance = 5 * attributes.mCompliance;
  attributes.mBendCompliance = 50 * attributes.mCompliance;
  settings.CreateConstraints(attributes, 1, Jolt.SoftBodySharedSettings_EBendType_Distance);
  settings.Optimize();
  return settings;
}

export function addSkirt(world, solids, center, waist) {
  const points = sewnPoints(solids, center, waist);
  const creation = new Jolt.SoftBodyCreationSettings(sharedSettings(points),
    new Jolt.RVec3(0, 0, 0), Jolt.Quat.prototype.sIdentity(), world.layer);
  creation.mNumIterations = ITERATIONS;
  creation.mVertexRadius = VERTEX_RADIUS;
  creation.mLinearDamping = 1;
  creation.mFriction = 0.5;
  creation.mPressure = 0;
  creation.mUpdatePosition = false;
  creation.mMakeRotationIdentity = true;
  creation.mAllowSleeping = false;
  const body = world.bodies.CreateSoftBody(creation);
  world.bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
  return { body, sewn: points };
}

// Where the vertices are now, three numbers each.
export function skirtPoints({ body }) {
  const motion = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);
  const vertices = motion.GetVertices();
  const first = Jolt.getPointer(vertices.at(0));
  const size = vertices.size() > 1 ? Jolt.getPointer(vertices.at(1)) - first : 0;
  const offset = Jolt.SoftBodyVertexTraits.prototype.mPositionOffset;
  const middle = body.GetCenterOfMassPosition();
  const base = [middle.GetX(), middle.GetY(), middle.GetZ()];
  const points = [];
  for (let i = 0; i < vertices.size(); ++i) {
    const at = (first + i * size + offset) / 4;
    points.push([0, 1, 2].map((k) => Jolt.HEAPF32[at + k] + base[k]));
  }
  return points;
}
