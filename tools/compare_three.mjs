// Compares the vertices of `gridreel bake` with those of three.js: GLTFLoader, AnimationMixer and
// Mesh.getVertexPosition, without a browser. Prints a table; tests/evaluator/README.md explains what differs and why.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const folder = process.env.THREE ?? process.cwd();
const gridreel =
  process.env.GRIDREEL ?? join(dirname(fileURLToPath(import.meta.url)), '../build/release/tools/gridreel');
const most_animations = 12, most_frames = 8, fps = 30;

// What three.js expects of a browser, for files whose images nobody looks at.
globalThis.self = globalThis;
globalThis.ProgressEvent ??= class extends Event {};
for (const level of ['warn', 'error']) console[level] = () => {};

let THREE, GLTFLoader, MeshoptDecoder;
try {
  const resolve = createRequire(join(folder, 'package.json')).resolve;
  const load = (module) => import(pathToFileURL(resolve(module)));
  THREE = await load('three/src/Three.js');
  ({ GLTFLoader } = await load('three/examples/jsm/loaders/GLTFLoader.js'));
  ({ MeshoptDecoder } = await load('three/examples/jsm/libs/meshopt_decoder.module.js'));
} catch (error) {
  process.stderr.write(`compare_three: no three in ${folder} (${error.message})\n` +
    'Install it in a folder of your choice (development only), and name that folder:\n' +
    '  npm install --prefix ~/three three@0.187.0\n' +
    '  THREE=~/three GRIDREEL=build/release/tools/gridreel tools/compare_three FILE.glb...\n');
  process.exit(2);
}

/// The file as GLTFLoader takes it: buffers beside a .gltf are moved into it.
function bytes_of(file) {
  const bytes = readFileSync(file);
  if (bytes.subarray(0, 4).toString() === 'glTF') return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const json = JSON.parse(bytes.toString());
  for (const buffer of json.buffers ?? []) {
    if (buffer.uri === undefined || buffer.uri.startsWith('data:')) continue;
    const data = readFileSync(join(dirname(file), decodeURIComponent(buffer.uri)));
    buffer.uri = `data:application/octet-stream;base64,${data.toString('base64')}`;
  }
  return JSON.stringify(json);
}

function load(file) {
  const loader = new GLTFLoader();
  loader.setMeshoptDecoder(MeshoptDecoder);
  loader.register((parser) => {
    parser.loadImageSource = () => Promise.resolve(new THREE.Texture());
    return { name: 'no_images' };
  });
  return loader.parseAsync(bytes_of(file), '');
}

/// World-space vertices of everything made of triangles, in the order of `gridreel bake`; x, y, z in turn.
function vertices_of({ scene, parser }) {
  scene.updateMatrixWorld(true);
  const vertices = [], point = new THREE.Vector3(), instance = new THREE.Matrix4();
  const emit = (mesh, index) => {
    for (let i = 0; i < (mesh.geometry.attributes.position?.count ?? 0); ++i) {
      mesh.getVertexPosition(i, point);
      if (index !== undefined) point.applyMatrix4(instance);
      point.applyMatrix4(mesh.matrixWorld);
      vertices.push(point.x, point.y, point.z);
    }
  };
  const is_node = (object) => parser.associations.get(object)?.nodes !== undefined;
  const visit = (object) => {
    // The primitives of an instanced mesh are siblings that are no nodes; each instance shows all of them.
    const instanced = object.isInstancedMesh
      ? [object]
      : object.children.filter((part) => part.isInstancedMesh && !is_node(part));
    const shown = new Set(instanced);
    for (let index = 0; index < (instanced[0]?.count ?? 0); ++index) {
      for (const mesh of instanced) {
        mesh.getMatrixAt(index, instance);
        emit(mesh, index);
      }
    }
    if (object.isMesh && !object.isInstancedMesh) emit(object);
    for (const child of object.children) if (!shown.has(child)) visit(child);
  };
  visit(scene);
  return vertices;
}

function read_ply(file) {
  const bytes = readFileSync(file);
  const end = bytes.indexOf('end_header\n') + 11;
  const count = Number(/element vertex (\d+)/.exec(bytes.subarray(0, end).toString())[1]);
  return Array.from({ length: 3 * count }, (_, i) => bytes.readFloatLE(end + 4 * i));
}

/// The largest distance between vertices of the same number, as a part of the bounding box's diagonal.
function difference(ours, theirs) {
  if (ours.length !== theirs.length) return `${ours.length / 3} vertices, three.js ${theirs.length / 3}`;
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  let largest = 0;
  for (let i = 0; i < ours.length; i += 3) {
    for (let axis = 0; axis < 3; ++axis) {
      low[axis] = Math.min(low[axis], ours[i + axis]);
      high[axis] = Math.max(high[axis], ours[i + axis]);
    }
    const distance =
      Math.hypot(ours[i] - theirs[i], ours[i + 1] - theirs[i + 1], ours[i + 2] - theirs[i + 2]);
    largest = Math.max(largest, distance);  // NaN stays
  }
  const diagonal = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  return ours.length === 0 ? 0 : largest / diagonal;
}

/// Up to `most_frames` frames, evenly over the clip, and one past its end.
function frames_of(duration_s) {
  const last = Math.floor(duration_s * fps);
  const frames = new Set([last + fps]);
  for (let i = 0; i < most_frames; ++i) frames.add(Math.round((i * last) / (most_frames - 1)));
  return [...frames].sort((a, b) => a - b);
}

/// The largest difference over the frames of one animation (absent: none plays).
function compare(file, gltf, animation) {
  const clip = gltf.animations[animation];
  const frames = frames_of(clip?.duration ?? 0);
  const out = mkdtempSync(join(tmpdir(), 'compare-three-'));
  try {
    execFileSync(gridreel, ['bake', file, '-o', join(out, '#####.ply'), '--fps', String(fps), '-f', frames.join(),
      '--animation', clip ? String(animation) : 'none', '-q'], { stdio: ['ignore', 'ignore', 'pipe'] });
    const mixer = new THREE.AnimationMixer(gltf.scene);
    let worst = { size: 0, frame: 0 };
    for (const name of readdirSync(out).filter((entry) => entry.endsWith('.ply'))) {
      const frame = Number.parseInt(name, 10);
      if (clip) {
        const action = mixer.clipAction(clip).reset().setLoop(THREE.LoopOnce);
        action.clampWhenFinished = true;
        action.play();
        mixer.setTime(frame / fps);
      }
      const size = difference(read_ply(join(out, name)), vertices_of(gltf));
      if (typeof size === 'string') return { size, frame };
      if (!(size <= worst.size)) worst = { size, frame };
    }
    mixer.stopAllAction();
    return worst;
  } finally {
    rmSync(out, { recursive: true });
  }
}

const rank = (size) => (typeof size === 'string' || Number.isNaN(size) ? Infinity : size);

async function worst_of(file) {
  let gltf;
  try {
    gltf = await load(file);
  } catch (error) {
    return { size: `three.js cannot load it: ${error.message}` };
  }
  const count = gltf.animations.length, step = Math.ceil(count / most_animations);
  let worst = { size: -1 };
  try {
    for (let animation = 0; animation < Math.max(count, 1); animation += Math.max(step, 1)) {
      const found = compare(file, gltf, animation);
      if (rank(found.size) > rank(worst.size)) worst = { ...found, animation: count > 0 ? animation : '-' };
    }
  } catch (error) {
    if (error.stderr === undefined) throw error;
    return { size: error.stderr.toString().trim().split('\n')[0] };
  }
  return worst;
}

const rows = [];
for (const file of process.argv.slice(2)) rows.push({ file, ...(await worst_of(file)) });
rows.sort((a, b) => rank(b.size) - rank(a.size));
console.log('| largest difference / diagonal | animation | frame | file |\n|--:|--:|--:|---|');
for (const { size, animation, frame, file } of rows) {
  const shown = typeof size === 'string' ? size : size.toExponential(1);
  console.log(`| ${shown} | ${animation ?? ''} | ${frame ?? ''} | ${file} |`);
}
