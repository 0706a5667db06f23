// Loads mujoco_colliders.xml and mujoco_meshes.xml into MuJoCo and compares what it then has with the
// result: balls and capsules of one radius are the same, pieces and meshes enclose their capsule and
// reach out no further than stated: at rest, and with the bodies moved as their joints.
//
//   node check_mujoco.mjs FOLDER
import { readFileSync } from 'node:fs';
import loadMujoco from 'mujoco-js';
import { check, distance, finish, near, signedDistance } from '../gltf/files.mjs';
import {
  add, compose, directions, dot, jointMoves, reach, surfacePoints, uprightSolids,
} from './geometry.mjs';

const TOLERANCE = 1e-6;
const OVERSHOOT = 0.005; // kDefaultOvershootM
const MESH_DEVIATION = 1 / Math.cos(Math.PI / 24) ** 2 - 1;
const [SPHERE, CAPSULE, MESH] = [2, 3, 7]; // mjtGeom
const GEOM = 5; // mjtObj

const folder = process.argv[2];
const solids = uprightSolids(folder);
const mujoco = await loadMujoco();
mujoco.FS.mkdir('/files');

function load(name) {
  mujoco.FS.writeFile(`/files/${name}`, readFileSync(`${folder}/${name}`, 'utf8'));
  const model = mujoco.MjModel.loadFromXML(`/files/${name}`);
  const data = new mujoco.MjData(model);
  mujoco.mj_forward(model, data);
  return { model, data };
}

// MuJoCo's Z up, X ahead.
const upright = ([x, y, z]) => [y, z, x];
// Rows of three times a vector.
const turned = (m, v) => [0, 1, 2].map((r) => m[3 * r] * v[0] + m[3 * r + 1] * v[1] + m[3 * r + 2] * v[2]);

// (The Z of a capsule given by fromto points back at its first point.)
// Each geom as the spheres at its ends, or its mesh's points, in the upright frame.
function geomsOf({ model, data }) {
  return Array.from({ length: model.ngeom }, (_, i) => {
    const position = Array.from(data.geom_xpos.slice(3 * i, 3 * i + 3));
    const matrix = Array.from(data.geom_xmat.slice(9 * i, 9 * i + 9));
    const at = (v) => upright(add(position, turned(matrix, v)));
    const geom = { name: mujoco.mj_id2name(model, GEOM, i), type: model.geom_type[i] };
    const [radius, half] = model.geom_size.slice(3 * i, 3 * i + 2);
    if (geom.type === SPHERE) geom.ends = [{ center: at([0, 0, 0]), radius }];
    if (geom.type === CAPSULE) {
      geom.ends = [half, -half].map((h) => ({ center: at([0, 0, h]), radius }));
    }
    if (geom.type === MESH) {
      const mesh = model.geom_dataid[i];
      geom.points = Array.from({ length: model.mesh_vertnum[mesh] }, (__, k) => {
        const first = 3 * (model.mesh_vertadr[mesh] + k);
        return at(Array.from(model.mesh_vert.slice(first, first + 3)));
      });
    }
    return geom;
  });
}

function checkSame(solid, geom) {
  check(geom.ends.length === solid.ends.length, `${solid.name} has ${geom.ends.length} spheres`);
  solid.ends.forEach((end, k) => {
    near(distance(geom.ends[k].center, end.center), 0, TOLERANCE, `${solid.name}: centre ${k}`);
    near(geom.ends[k].radius, end.radius, TOLERANCE, `${solid.name}: radius ${k}`);
  });
}
function checkPieces(solid, pieces) {
  for (const point of surfacePoints(solid.ends, 100)) {
    const out = Math.min(...pieces.map((piece) => signedDistance(piece.ends, point)));
    check(out <= TOLERANCE, `${solid.name}: ${out} m are left out`);
  }
  for (const piece of pieces) {
    for (const point of surfacePoints(piece.ends, 100)) {
      const over = signedDistance(solid.ends, point);
      check(over <= OVERSHOOT + TOLERANCE, `${piece.name} is ${over} m too large`);
    }
  }
}
function checkMesh(solid, geom) {
  const allowed = MESH_DEVIATION * Math.max(...solid.ends.map((end) => end.radius));
  for (const direction of directions(200)) {
    const beyond = Math.max(...geom.points.map((p) => dot(p, direction))) - reach(solid.ends, direction);
    check(beyond >= -TOLERANCE, `${solid.name}: the mesh leaves out ${-beyond} m`);
    check(beyond <= allowed + TOLERANCE, `${solid.name}: the mesh is ${beyond} m too large`);
  }
}
// XML has no control characters.
const inXml = (name) => name.replace(/[\x00-\x1f\x7f]/g, '_');
const isTapered = ({ ends }) => ends.length === 2 && ends[0].radius !== ends[1].radius;

// Each body is a joint's, moved by its mocap pose; bodies are in the order of their joints.
const inMujoco = ([x, y, z]) => [z, x, y];
function moveBodies({ model, data }) {
  const moves = jointMoves(folder);
  const used = [...new Set(solids.map((solid) => solid.joint))].sort((a, b) => a - b);
  check(model.nmocap === used.length, `${model.nmocap} mocap bodies for ${used.length} joints`);
  used.forEach((joint, i) => {
    const [w, x, y, z] = data.mocap_quat.slice(4 * i, 4 * i + 4);
    const rest = { position: Array.from(data.mocap_pos.slice(3 * i, 3 * i + 3)), rotation: [x, y, z, w] };
    const { position, rotation } = moves(joint);
    const moved = compose({
      position: inMujoco(position),
      rotation: [...inMujoco(rotation.slice(0, 3)), rotation[3]],
    }, rest);
    moved.position.forEach((value, k) => { data.mocap_pos[3 * i + k] = value; });
    [3, 0, 1, 2].forEach((from, k) => { data.mocap_quat[4 * i + k] = moved.rotation[from]; });
  });
  mujoco.mj_forward(model, data);
}

function checkPiecesFile(geoms, wanted) {
  let counted = 0;
  for (const solid of wanted) {
    const own = geoms.filter(({ name }) =>
      name.startsWith(inXml(solid.name)) && /^(_\d+)?$/.test(name.slice(inXml(solid.name).length)));
    counted += own.length;
    if (own.length === 0) check(false, `${solid.name} is missing`);
    else if (isTapered(solid)) checkPieces(solid, own);
    else checkSame(solid, own[0]);
  }
  check(counted === geoms.length, `${geoms.length} geoms, of which ${counted} are known`);
}
function checkMeshesFile(geoms, wanted) {
  check(geoms.length === wanted.length, `${geoms.length} geoms for ${wanted.length} solids`);
  for (const solid of wanted) {
    const geom = geoms.find(({ name }) => name === inXml(solid.name));
    if (!geom) check(false, `${solid.name} is missing`);
    else if (geom.points) checkMesh(solid, geom);
    else checkSame(solid, geom);
  }
}

const posed = uprightSolids(folder, true);
const counts = [['mujoco_colliders.xml', checkPiecesFile], ['mujoco_meshes.xml', checkMeshesFile]]
  .map(([name, checkFile]) => {
    const file = load(name);
    checkFile(geomsOf(file), solids);
    moveBodies(file);
    checkFile(geomsOf(file), posed);
    return file.model.ngeom;
  });
finish(`${counts[0]} geoms and ${counts[1]} meshes in MuJoCo, at rest and posed`);
