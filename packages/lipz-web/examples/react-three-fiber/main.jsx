// A face in React Three Fiber that speaks a line.

import { openDialogue } from "@lipz/reader";
import { Canvas, useLoader } from "@react-three/fiber";
import { Suspense, use } from "react";
import { createRoot } from "react-dom/client";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { useLips } from "./use-lips.js";

function Head({ opening, model, line, time }) {
  const dialogue = use(opening);
  const { scene } = useLoader(GLTFLoader, model);
  useLips(scene, dialogue.clip(line), dialogue.rig("arkit"), time);
  return <primitive object={scene} />;
}

/** Shows the face in an element, at the position of the audio that `time` returns in seconds. */
export function speaker(element, { bank, model, key }, time) {
  createRoot(element).render(
    <Canvas camera={{ position: [0, 0, 3.5], fov: 40 }}>
      <color attach="background" args={["white"]} />
      <hemisphereLight />
      <Suspense>
        <Head opening={openDialogue([bank])} model={model} line={key} time={time} />
      </Suspense>
    </Canvas>,
  );
}
