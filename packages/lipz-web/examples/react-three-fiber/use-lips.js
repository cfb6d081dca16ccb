import { rig } from "@lipz/reader";
import { useFrame } from "@react-three/fiber";
import { useMemo } from "react";

/**
 * Moves the blend shapes of all meshes of `head`. `clip` is the line, `weights` the rig of the bank, and `time` a
 * function that returns the position of the audio in seconds.
 */
export function useLips(head, clip, weights, time) {
  const move = useMemo(() => {
    const meshes = [];
    head.traverse((mesh) => {
      if (mesh.morphTargetDictionary) meshes.push({ mesh, shapes: rig(mesh.morphTargetDictionary, weights) });
    });
    const settings = { out: new Float32Array(weights.weightNames.length) };
    return (seconds) => {
      clip.weightsAt(seconds, weights, settings);
      for (const { mesh, shapes } of meshes) shapes.apply(settings.out, mesh.morphTargetInfluences);
    };
  }, [head, clip, weights]);
  useFrame(() => move(time()));
}
