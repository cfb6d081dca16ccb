// A face in three.js that speaks a line.

import { openDialogue, rig } from "@lipz/reader";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Loads a bank and a model with blend shapes, and returns a function that draws the face at a time of the line. */
export async function speaker(canvas, { bank, model, key }) {
  const [dialogue, { scene: head }] = await Promise.all([openDialogue([bank]), new GLTFLoader().loadAsync(model)]);
  const clip = dialogue.clip(key);
  const weights = dialogue.rig("arkit"); // or "ovr", if your model has only visemes
  const meshes = [];
  head.traverse((mesh) => {
    if (mesh.morphTargetDictionary) meshes.push({ mesh, shapes: rig(mesh.morphTargetDictionary, weights) });
  });

  const renderer = new THREE.WebGLRenderer({ canvas });
  const scene = new THREE.Scene().add(head, new THREE.HemisphereLight());
  const { center, radius } = new THREE.Box3().setFromObject(head).getBoundingSphere(new THREE.Sphere());
  const camera = new THREE.PerspectiveCamera(40, canvas.width / canvas.height, radius / 10, radius * 10);
  camera.position.set(center.x, center.y, center.z + 3 * radius);
  scene.background = new THREE.Color("white");

  const settings = { out: new Float32Array(weights.weightNames.length) };
  return (seconds) => {
    clip.weightsAt(seconds, weights, settings);
    for (const { mesh, shapes } of meshes) shapes.apply(settings.out, mesh.morphTargetInfluences);
    renderer.render(scene, camera);
  };
}
