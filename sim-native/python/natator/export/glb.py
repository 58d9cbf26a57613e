"""Bodies as meshes with bones: glTF 2.0."""

import json

import numpy as np

from natator.errors import InputError
from natator.export.bodies import Rig, colours, quaternion

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
TYPES = {"f": (FLOAT, "<f4"), "H": (UNSIGNED_SHORT, "<u2"), "I": (UNSIGNED_INT, "<u4")}
OF_VERTICES, OF_INDICES = {"target": 34962}, {"target": 34963}
ROUGHNESS = 0.6


class Glb:
    """`swim.glb`: each creature is a mesh with a bone for each of its clusters; a bone has the rigid motion nearest to that of its
    cluster's particles. Key frames are seconds; the unit of length counts as a metre."""

    def __init__(self, swim, folder):
        if not swim.surfaces():
            raise InputError(f"--format glb: {swim.scene['scene']} has no body with a surface; expected one")
        self._swim, self._file = swim, folder / "swim.glb"
        self._rigs, self._times, self._motions = None, [], {}

    def frame(self, frame):
        if self._rigs is None:
            self._rigs = {name: Rig(self._swim, creature, frame.position) for name, creature in self._swim.surfaces().items()}
        self._times.append(frame.time)
        for name, rig in self._rigs.items():
            self._motions.setdefault(name, []).append([(*pose[1:], quaternion(pose[0])) for pose in rig.motions(frame.position)])

    def finish(self):
        document = {"asset": {"version": "2.0", "generator": self._swim.title}, "scene": 0, "scenes": [{"name": "Swim", "nodes": []}],
                    "nodes": [], "meshes": [], "skins": [], "accessors": [], "bufferViews": [],
                    "materials": [{"name": "Skin", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": ROUGHNESS}}],
                    "animations": [{"name": "Swim", "samplers": [], "channels": []}]}
        self._document, self._numbers = document, bytearray()
        times = self._accessor("SCALAR", "f", np.array(self._times)[:, None], bounded=True)
        for name, rig in self._rigs.items():
            self._add(name, rig, times)
        document["buffers"] = [{"byteLength": len(self._numbers)}]
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        self._file.write_bytes(b"".join([np.array([0x46546C67, 2, 28 + len(text) + len(self._numbers)], "<u4").tobytes(),
                                         np.array([len(text), 0x4E4F534A], "<u4").tobytes(), text,
                                         np.array([len(self._numbers), 0x004E4942], "<u4").tobytes(), self._numbers]))

    def _add(self, name, rig, times):
        centres, places, turns = (np.array([[bone[i] for bone in frame] for frame in self._motions[name]]) for i in range(3))
        flips = np.cumprod(np.where((turns[1:] * turns[:-1]).sum(2) < 0, -1, 1), 0)  # q and -q are the same turn: curves do not jump
        turns[1:] *= flips[..., None]
        bones, animation = [], self._document["animations"][0]
        for bone in range(places.shape[1]):
            bones.append(self._to("nodes", {"name": f"{name}Cluster{bone}", "translation": _floats(places[0, bone]),
                                            "rotation": _floats(turns[0, bone])}))
            for path, kind, values in (("translation", "VEC3", places), ("rotation", "VEC4", turns)):
                animation["channels"].append({"sampler": len(animation["samplers"]), "target": {"node": bones[-1], "path": path}})
                animation["samplers"].append({"input": times, "output": self._accessor(kind, "f", values[:, bone]),
                                              "interpolation": "LINEAR"})
        root = self._to("nodes", {"name": f"{name}Rig", "children": bones})
        to_bones = np.tile(np.eye(4), (len(bones), 1, 1))
        to_bones[:, 3, :3] = -centres[0]  # by columns
        skin = self._to("skins", {"name": name, "joints": bones, "skeleton": root,
                                  "inverseBindMatrices": self._accessor("MAT4", "f", to_bones.reshape(-1, 16))})
        attributes = {"POSITION": self._accessor("VEC3", "f", rig.vertices, OF_VERTICES, True),
                      "NORMAL": self._accessor("VEC3", "f", rig.normals(), OF_VERTICES),
                      "COLOR_0": self._accessor("VEC3", "f", colours(rig.cluster), OF_VERTICES),
                      "JOINTS_0": self._accessor("VEC4", "H", rig.bones, OF_VERTICES),
                      "WEIGHTS_0": self._accessor("VEC4", "f", rig.shares, OF_VERTICES)}
        corners = self._accessor("SCALAR", "I", rig.triangles.reshape(-1, 1), OF_INDICES)
        mesh = self._to("meshes", {"name": name, "primitives": [{"attributes": attributes, "indices": corners, "material": 0}]})
        self._document["scenes"][0]["nodes"] += [root, self._to("nodes", {"name": name, "mesh": mesh, "skin": skin})]

    def _to(self, key, value):
        """Appends to a list; returns the index."""
        self._document[key].append(value)
        return len(self._document[key]) - 1

    def _accessor(self, kind, letter, values, target={}, bounded=False):
        component, dtype = TYPES[letter]
        values = np.ascontiguousarray(values, dtype)
        view = self._to("bufferViews", {"buffer": 0, "byteOffset": len(self._numbers), "byteLength": values.nbytes, **target})
        self._numbers += values.tobytes()  # all of them take whole words
        bounds = {"min": values.min(0).tolist(), "max": values.max(0).tolist()} if bounded else {}
        return self._to("accessors", {"bufferView": view, "componentType": component, "count": len(values), "type": kind, **bounds})

    def close(self):
        """Does nothing: no file is open before the end."""


def _floats(values):
    return np.float32(values).tolist()
