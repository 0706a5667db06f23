// Points of capsules, and whether shapes of other kinds cover them.
import { signedDistance } from './files.mjs';
import { THREE, vector } from './three_scene.mjs';

// Points of the hull's surface: where rays from the axis leave it.
export function surfacePoints(ends, unit) {
  const [a, b] = [ends[0], ends.at(-1)].map((e) => vector(e.center));
  const points = [];
  for (let i = 0; i < 400; i += 1) {
    const y = 1 - (2 * i + 1) / 400;
    const turned = i * 2.399963;
    const flat = Math.sqrt(1 - y * y);
    const direction = new THREE.Vector3(flat * Math.cos(turned), y, flat * Math.sin(turned));
    const start = a.clone().lerp(b, (i % 21) / 20);
    let [low, high] = [0, 10 * unit];
    for (let k = 0; k < 60; k += 1) {
      const middle = (low + high) / 2;
      const at = start.clone().addScaledVector(direction, middle).toArray();
      if (signedDistance(ends, at) < 0) low = middle; else high = middle;
    }
    points.push(start.addScaledVector(direction, low).toArray());
  }
  return points;
}

// What is wrong with pieces (each one sphere, or two of the same radius) that stand for a solid:
// their union must contain it, and stand out by `overshoot` at most. `unit`: units in a metre.
export function coverageProblems(solid, pieces, overshoot, unit) {
  const problems = pieces.length === 0 ? [`${solid.name} is missing`] : [];
  for (const point of surfacePoints(solid.ends, unit)) {
    const out = Math.min(...pieces.map((ends) => signedDistance(ends, point)));
    if (!(out <= 1e-6 * unit)) problems.push(`${solid.name} sticks out by ${out}`);
  }
  for (const end of pieces.flat()) {
    const over = signedDistance(solid.ends, end.center) + end.radius;
    if (!(over <= overshoot + 1e-6 * unit)) problems.push(`${solid.name} is ${over} too large`);
  }
  return problems;
}
