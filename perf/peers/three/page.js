// Draws one model with three.js as the orders say. Asks the server for an order, carries it out, posts the answer.
// The canvas is in no document: nothing is composited, so what is timed is three.js and the driver alone.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';

const canvas = document.createElement('canvas');
let renderer, scene, camera, size;

/** The driver behind WebGL, in its own words. */
function driver() {
  const gl = renderer.getContext();
  const extension = gl.getExtension('WEBGL_debug_renderer_info');
  return extension ? gl.getParameter(extension.UNMASKED_RENDERER_WEBGL) : 'hidden by the browser';
}

/** halfframe's light colours are irradiance / pi; three.js wants irradiance (lux) and candela. */
function addLights(order) {
  for (const { direction, color } of order.suns) {
    const sun = new THREE.DirectionalLight(new THREE.Color().setRGB(...color), Math.PI);
    sun.position.set(-direction[0], -direction[1], -direction[2]);
    scene.add(sun, sun.target);
  }
  for (const { position, color, range_m } of order.points) {
    const point = new THREE.PointLight(new THREE.Color().setRGB(...color), Math.PI, range_m, 2);
    point.position.set(...position);
    scene.add(point);
  }
}

async function addEnvironment(order) {
  const equirectangular = await new HDRLoader().loadAsync(`/file?path=${encodeURIComponent(order.environment)}`);
  equirectangular.mapping = THREE.EquirectangularReflectionMapping;
  const prefilter = new THREE.PMREMGenerator(renderer);
  scene.environment = prefilter.fromEquirectangular(equirectangular).texture;
  scene.environmentIntensity = order.environment_scale;
}

function makeCamera({ world_from_view, fov_y_rad, near_m, far_m }) {
  camera = new THREE.PerspectiveCamera(THREE.MathUtils.radToDeg(fov_y_rad), size.width / size.height, near_m, far_m);
  camera.matrixAutoUpdate = false;
  camera.matrix.fromArray(world_from_view);
  camera.updateMatrixWorld(true);
}

/** Keeps meshes, leaves out the file's own lights and cameras, and lets a frame change nothing. */
function addModel(model) {
  const leftOut = [];
  model.traverse((node) => { if (node.isLight) leftOut.push(node); });
  for (const light of leftOut) light.removeFromParent();
  scene.add(model);
}

function drawAndWait() {
  const gl = renderer.getContext();
  renderer.render(scene, camera);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // the only wait that WebGL offers
}

const orders = {
  async load(order) {
    size = { width: order.width, height: order.height };
    renderer = new THREE.WebGLRenderer({ canvas, antialias: false, powerPreference: 'high-performance',
                                         preserveDrawingBuffer: true });
    renderer.setPixelRatio(1);
    renderer.setSize(size.width, size.height, false);
    renderer.toneMapping = THREE.NoToneMapping;
    renderer.shadowMap.enabled = false;
    renderer.setClearColor(new THREE.Color().setRGB(...order.background), 1);
    scene = new THREE.Scene();
    makeCamera(order.camera);
    addLights(order);
    await addEnvironment(order);
    const gltf = await new GLTFLoader().loadAsync(`/file${order.model}`);
    addModel(gltf.scene);
    drawAndWait();
    return { renderer: driver(), version: `three.js r${THREE.REVISION}`, lit_by: 'environment',
             draws: renderer.info.render.calls, triangles: renderer.info.render.triangles, notices: [] };
  },

  async draw({ frames }) {
    drawAndWait();  // wakes what fell asleep while the others drew
    const start = performance.now();
    for (let frame = 0; frame < frames; ++frame) drawAndWait();
    return { ms: performance.now() - start };
  },

  async picture({ file }) {
    drawAndWait();
    const gl = renderer.getContext();
    const rows = new Uint8Array(size.width * size.height * 4);
    gl.readPixels(0, 0, size.width, size.height, gl.RGBA, gl.UNSIGNED_BYTE, rows);
    await fetch(`/picture?path=${encodeURIComponent(file)}`, { method: 'POST', body: rows });
    return { file, bottom_up: true };
  },
};

async function answer(order) {
  try {
    return await orders[order.do](order);
  } catch (error) {
    return { error: `${order.do}: ${error?.message ?? error}` };
  }
}

for (;;) {
  const order = await (await fetch('/order')).json();
  await fetch('/answer', { method: 'POST', body: JSON.stringify(await answer(order)) });
}
