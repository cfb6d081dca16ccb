"""The part of Blender's `bpy` that an exported script uses, with linear curves. Prints the weights of each frame.

usage: python3 bpy.py SCRIPT.py NAMES.json FRAMES
"""

import json
import runpy
import sys
import types


class Point:
    def __init__(self, frame, value):
        self.co = types.SimpleNamespace(x=frame, y=value)
        self.interpolation = "BEZIER"


class Curve:
    def __init__(self, data_path):
        self.data_path, self.keyframe_points = data_path, []

    def evaluate(self, frame):
        points = self.keyframe_points
        assert all(point.interpolation == "LINEAR" for point in points), "Blender eases keys by default"
        if frame <= points[0].co.x:
            return points[0].co.y
        for before, after in zip(points, points[1:]):
            if frame <= after.co.x:
                share = (frame - before.co.x) / (after.co.x - before.co.x)
                return before.co.y + (after.co.y - before.co.y) * share
        return points[-1].co.y


class Block:
    def __init__(self, name, curves):
        self.name, self.value, self.curves = name, 0.0, curves

    def path_from_id(self, attribute):
        return f'key_blocks["{self.name}"].{attribute}'

    def keyframe_insert(self, attribute, frame):
        curve = self.curves.setdefault(self.name, Curve(self.path_from_id(attribute)))
        curve.keyframe_points.append(Point(frame, self.value))


class Bag:
    def __init__(self, curves):
        self.curves = curves

    @property
    def fcurves(self):
        return list(self.curves.values())


def main(script, names, frames):
    names, curves = json.load(open(names)), {}
    action = types.SimpleNamespace(layers=[])
    action.layers.append(types.SimpleNamespace(strips=[types.SimpleNamespace(channelbags=[Bag(curves)])]))
    blocks = {name: Block(name, curves) for name in names}
    keys = types.SimpleNamespace(key_blocks=blocks, animation_data=types.SimpleNamespace(action=action))
    face = types.SimpleNamespace(type="MESH", data=types.SimpleNamespace(shape_keys=keys))
    render = types.SimpleNamespace(fps=24, fps_base=1.0)
    bpy = types.ModuleType("bpy")
    bpy.context = types.SimpleNamespace(object=face, scene=types.SimpleNamespace(frame_current=10, render=render))
    sys.modules["bpy"] = bpy
    runpy.run_path(script, run_name="__main__")
    rows = [[curves[name].evaluate(10 + frame) if name in curves else None for name in names] for frame in range(frames)]
    json.dump(rows, sys.stdout)


main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
