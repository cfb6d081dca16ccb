// A VRM avatar in three.js that speaks a line.

import { openDialogue, rig } from "@lipz/reader";
import { VRMLoaderPlugin } from "@pixiv/three-vrm";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** Loads a bank and an avatar, and returns a function that draws the avatar at a time of the line. */
export async function speaker(canvas, { bank, model, key }) {
  const loader = new GLTFLoader().register((parser) => new VRMLoaderPlugin(parser));
  const [dialogue, { userData }] = await Promise.all([openDialogue([bank]), loader.loadAsync(model)]);
  const clip = dialogue.clip(key);
  const { vrm } = userData;
  const weights = dialogue.rig("vrm");
  const shapes = rig(Object.keys(vrm.expressionManager.expressionMap), weights);

  const renderer = new THREE.WebGLRenderer({ canvas });
  const scene = new THREE.Scene().add(vrm.scene, new THREE.HemisphereLight());
  const { center, radius } = new THREE.Box3().setFromObject(vrm.scene).getBoundingSphere(new THREE.Sphere());
  const camera = new THREE.PerspectiveCamera(40, canvas.width / canvas.height, radius / 10, radius * 10);
  camera.position.set(center.x, center.y, center.z + 3 * radius);
  scene.background = new THREE.Color("white");

  const settings = { out: new Float32Array(weights.weightNames.length) };
  const express = (name, weight) => vrm.expressionManager.setValue(name, weight);
  let last = 0;
  return (seconds) => {
    shapes.forEach(clip.weightsAt(seconds, weights, settings), express);
    vrm.update(Math.max(0, seconds - last)); // also moves hair and clothes
    last = seconds;
    renderer.render(scene, camera);
  };
}
