// A face in PlayCanvas that speaks a line.

import { openDialogue, rig } from "@lipz/reader";
import * as pc from "playcanvas";

/** Loads a file as an asset. */
function loaded(app, name, type, url) {
  const asset = new pc.Asset(name, type, { url });
  app.assets.add(asset);
  return new Promise((resolve, reject) => {
    asset.once("load", () => resolve(asset.resource));
    asset.once("error", (message) => reject(new Error(message)));
    app.assets.load(asset);
  });
}

/** Loads a bank and a model with morph targets, and returns a function that draws the face at a time of the line. */
export async function speaker(canvas, { bank, model, key }) {
  const app = new pc.Application(canvas);
  const [dialogue, container] = await Promise.all([openDialogue([bank]), loaded(app, "face", "container", model)]);
  const clip = dialogue.clip(key);
  const weights = dialogue.rig("arkit"); // or "ovr", if your model has only visemes
  const head = container.instantiateRenderEntity();
  const instances = head.findComponents("render").flatMap(({ meshInstances }) => meshInstances);
  const morphs = instances.map(({ morphInstance }) => morphInstance).filter(Boolean);
  const setters = morphs.map((morph) => {
    const shapes = rig(morph.morph.targets.map(({ name }) => name), weights);
    return { shapes, set: (name, weight, index) => morph.setWeight(index, weight) };
  });

  const { center, halfExtents } = instances[0].aabb;
  const camera = new pc.Entity("camera");
  camera.addComponent("camera", { clearColor: pc.Color.WHITE, fov: 40 });
  camera.setPosition(center.x, center.y, center.z + 3 * halfExtents.length());
  const light = new pc.Entity("light").addComponent("light").entity;
  for (const entity of [head, camera, light]) app.root.addChild(entity);

  const settings = { out: new Float32Array(weights.weightNames.length) };
  app.start();
  app.autoRender = false;
  return (seconds) => {
    clip.weightsAt(seconds, weights, settings);
    for (const { shapes, set } of setters) shapes.forEach(settings.out, set);
    app.renderNextFrame = true;
  };
}
