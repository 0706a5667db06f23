// What KHR_implicit_shapes and KHR_physics_rigid_bodies ask of a file, as far as colliders go: the
// validator knows neither. Returns what is wrong, in words.
const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);
const isIndex = (value, count) => Number.isInteger(value) && value >= 0 && value < count;

// Members beside those named, and those that every object may have.
const strangers = (object, known) => Object.keys(object)
  .filter((key) => ![...known, 'name', 'extensions', 'extras'].includes(key));

function shapeProblems(shape) {
  const kinds = ['sphere', 'box', 'capsule', 'cylinder', 'plane'];
  const problems = strangers(shape, ['type', ...kinds]).map((key) => `has ${key}`);
  if (typeof shape.type !== 'string') return [...problems, 'has no type'];
  for (const kind of kinds) {
    if (kind !== shape.type && shape[kind] !== undefined) problems.push(`is no ${kind} but has one`);
  }
  if (shape.type === 'sphere') {
    const radius = shape.sphere?.radius ?? 0.5;
    if (!isNumber(radius) || radius <= 0) problems.push(`sphere.radius ${radius}`);
    problems.push(...strangers(shape.sphere ?? {}, ['radius']));
  }
  if (shape.type === 'capsule') {
    const { height = 0.5, radiusTop = 0.25, radiusBottom = 0.25 } = shape.capsule ?? {};
    if (!isNumber(height) || height <= 0) problems.push(`capsule.height ${height}`);
    if (!isNumber(radiusTop) || radiusTop < 0) problems.push(`capsule.radiusTop ${radiusTop}`);
    if (!isNumber(radiusBottom) || radiusBottom < 0) problems.push(`radiusBottom ${radiusBottom}`);
    if (radiusTop === 0 && radiusBottom === 0) problems.push('capsule without radii');
    problems.push(...strangers(shape.capsule ?? {}, ['height', 'radiusTop', 'radiusBottom']));
  }
  return problems;
}

function bodyProblems(body, shapeCount) {
  const problems = strangers(body, ['motion', 'collider', 'trigger', 'joint']);
  const { collider } = body;
  if (!collider) return problems;
  problems.push(...strangers(collider, ['geometry', 'physicsMaterial', 'collisionFilter']));
  if (typeof collider.geometry !== 'object') return [...problems, 'collider without geometry'];
  problems.push(...strangers(collider.geometry, ['shape', 'mesh', 'node', 'convexHull']));
  if (!isIndex(collider.geometry.shape, shapeCount)) {
    problems.push(`collider.geometry.shape ${collider.geometry.shape} of ${shapeCount}`);
  }
  return problems;
}

export function colliderProblems(gltf) {
  const problems = [];
  const used = gltf.extensionsUsed ?? [];
  if (new Set(used).size !== used.length) problems.push('extensionsUsed repeats itself');
  const own = gltf.extensions?.KHR_implicit_shapes;
  const shapes = own?.shapes ?? [];
  if (own && !used.includes('KHR_implicit_shapes')) problems.push('shapes are not declared');
  if (own && shapes.length < 1) problems.push('shapes is empty');
  shapes.forEach((shape, s) => {
    for (const problem of shapeProblems(shape)) problems.push(`shape ${s}: ${problem}`);
  });
  (gltf.nodes ?? []).forEach((node, n) => {
    const body = node.extensions?.KHR_physics_rigid_bodies;
    if (!body) return;
    if (!used.includes('KHR_physics_rigid_bodies')) problems.push('bodies are not declared');
    for (const problem of bodyProblems(body, shapes.length)) problems.push(`node ${n}: ${problem}`);
  });
  return problems;
}
