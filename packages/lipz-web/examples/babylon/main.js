// A face in Babylon.js that speaks a line.

import { ArcRotateCamera, Color4, Engine, HemisphericLight, Scene, Vector3 } from "@babylonjs/core";
import { LoadAssetContainerAsync } from "@babylonjs/core/Loading/sceneLoader.js";
import { openDialogue, rig } from "@lipz/reader";
import "@babylonjs/loaders/glTF/index.js";

/** Loads a bank and a model with morph targets, and returns a function that draws the face at a time of the line. */
export async function speaker(canvas, { bank, model, key }) {
  const engine = new Engine(canvas);
  const scene = new Scene(engine);
  const [dialogue, container] = await Promise.all([openDialogue([bank]), LoadAssetContainerAsync(model, scene)]);
  container.addAllToScene();
  const clip = dialogue.clip(key);
  const weights = dialogue.rig("arkit"); // or "ovr", if your model has only visemes
  const managers = new Set(container.meshes.map((mesh) => mesh.morphTargetManager).filter(Boolean));
  const setters = Array.from(managers, (manager) => {
    const targets = Array.from({ length: manager.numTargets }, (_, index) => manager.getTarget(index));
    const shapes = rig(targets.map((target) => target.name), weights);
    return { shapes, set: (name, weight, index) => (targets[index].influence = weight) };
  });

  const { min, max } = scene.getWorldExtends();
  const camera = new ArcRotateCamera("camera", Math.PI / 2, Math.PI / 2, 1, Vector3.Center(min, max), scene);
  camera.radius = 1.5 * Vector3.Distance(min, max);
  camera.minZ = camera.radius / 100;
  new HemisphericLight("light", Vector3.Up(), scene);
  scene.clearColor = new Color4(1, 1, 1, 1);

  const settings = { out: new Float32Array(weights.weightNames.length) };
  return (seconds) => {
    clip.weightsAt(seconds, weights, settings);
    for (const { shapes, set } of setters) shapes.forEach(settings.out, set);
    scene.render();
  };
}
