"""Reads a .glb by pygltflib and moves its meshes by their bones as the glTF 2.0 specification says."""

import numpy as np
import pygltflib

WIDTH = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}
KIND = {5123: "<u2", 5125: "<u4", 5126: "<f4"}


def matrix(translation, rotation):
    x, y, z, w = rotation
    result = np.eye(4)
    result[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    result[:3, 3] = translation
    return result


class Body:
    """A mesh with bones: places (V, 3), triangles (T, 3), and where the bones bring it at each key frame."""

    def __init__(self, places, triangles, joints, weights, bindings, motions):
        self.places, self.triangles = places, triangles
        self._joints, self._weights, self._bindings, self._motions = joints, weights, bindings, motions

    def moved(self, key):
        bones = np.array([matrix(*motion[key]) @ binding for motion, binding in zip(self._motions, self._bindings)])
        blended = np.einsum("vk,vkij->vij", self._weights, bones[self._joints])
        return np.einsum("vij,vj->vi", blended, np.column_stack([self.places, np.ones(len(self.places))]))[:, :3]


class Glb:
    """All bodies of a file by name, and the times of its key frames, s."""

    def __init__(self, file):
        self._document = pygltflib.GLTF2().load(str(file))
        self._blob = self._document.binary_blob()
        document = self._document
        animation = document.animations[0]
        channels = {(channel.target.node, channel.target.path): animation.samplers[channel.sampler]
                    for channel in animation.channels}
        self.times = self._array(animation.samplers[0].input).ravel()
        self.bodies = {}
        for node in document.nodes:
            if node.mesh is None:
                continue
            skin, primitive = document.skins[node.skin], document.meshes[node.mesh].primitives[0]
            attributes = primitive.attributes
            motions = [list(zip(*(self._array(channels[joint, path].output) for path in ("translation", "rotation"))))
                       for joint in skin.joints]
            bindings = self._array(skin.inverseBindMatrices).reshape(-1, 4, 4).transpose(0, 2, 1)
            self.bodies[node.name] = Body(
                self._array(attributes.POSITION), self._array(primitive.indices).reshape(-1, 3),
                self._array(attributes.JOINTS_0), self._array(attributes.WEIGHTS_0), bindings, motions)

    def _array(self, index):
        accessor = self._document.accessors[index]
        view = self._document.bufferViews[accessor.bufferView]
        count = accessor.count * WIDTH[accessor.type]
        values = np.frombuffer(self._blob, KIND[accessor.componentType], count, view.byteOffset)
        return values.reshape(accessor.count, -1)
