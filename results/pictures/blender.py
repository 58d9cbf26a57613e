"""Renders a swim in Blender with Cycles: water as a surface of glass, the body as skin.

    blender.py WATER/swim.usdc BODY/swim.glb TIME PICTURE.png

WATER is `python -m natator export --format usdc --water-surface`, BODY is `--format glb` of the same swim; TIME is in s. Runs where
`pip install bpy` is, without a display, or in Blender: blender --background --python blender.py -- ARGUMENTS.
Writes PICTURE.blend beside the picture, to go on with by hand.
"""

import sys
from math import radians
from pathlib import Path

import bpy
from mathutils import Vector

FRAMES_PER_SECOND = 60
SIZE, SAMPLES = (960, 480), 32
EDGE_DEGREES = 35
WATER, SKIN, GROUND = (0.30, 0.62, 0.80, 1), (0.90, 0.25, 0.05, 1), (0.80, 0.78, 0.74, 1)


def import_swim(water, body):
    """The water's surface and the body's meshes; frame by frame as they were simulated."""
    bpy.context.scene.render.fps = FRAMES_PER_SECOND  # first: glTF counts seconds, Blender frames
    bpy.ops.wm.usd_import(filepath=water)
    surface = bpy.data.objects["WaterSurface"]
    for name in [one.name for one in bpy.data.objects if one.type in {"MESH", "CURVES", "POINTCLOUD"} and one != surface]:
        bpy.data.objects.remove(bpy.data.objects[name])  # the body comes with bones below
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=body)
    bodies = [one for one in set(bpy.data.objects) - before if one.find_armature()]
    return surface, bodies


def material(name, colour, roughness):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = colour
    shader.inputs["Roughness"].default_value = roughness
    return made, shader


def water_material():
    """Refracts by 1.33 and absorbs red; lets light through to the floor, which glass in Cycles does not."""
    made, shader = material("Water", (1, 1, 1, 1), 0)
    shader.inputs["Transmission Weight"].default_value = 1
    shader.inputs["IOR"].default_value = 1.33
    nodes, links = made.node_tree.nodes, made.node_tree.links
    output = nodes["Material Output"]
    path, clear, mix = (nodes.new(kind) for kind in ("ShaderNodeLightPath", "ShaderNodeBsdfTransparent", "ShaderNodeMixShader"))
    links.new(path.outputs["Is Shadow Ray"], mix.inputs[0])
    links.new(shader.outputs[0], mix.inputs[1])
    links.new(clear.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], output.inputs["Surface"])
    absorption = nodes.new("ShaderNodeVolumeAbsorption")
    absorption.inputs["Color"].default_value = WATER
    absorption.inputs["Density"].default_value = 0.6
    links.new(absorption.outputs[0], output.inputs["Volume"])
    return made


def dress(thing, made):
    thing.data.materials.clear()
    thing.data.materials.append(made)


def dress_water(surface, made):
    """Geometry nodes: the mesh is another in every frame, so that its material and edges are set anew."""
    tree = surface.modifiers.new("Dress", "NODES").node_group = bpy.data.node_groups.new("Dress", "GeometryNodeTree")
    for direction in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=direction, socket_type="NodeSocketGeometry")
    first, angle, steep, edges, colour, last = (tree.nodes.new(kind) for kind in (
        "NodeGroupInput", "GeometryNodeInputMeshEdgeAngle", "FunctionNodeCompare",
        "GeometryNodeSetShadeSmooth", "GeometryNodeSetMaterial", "NodeGroupOutput"))
    steep.operation = "GREATER_THAN"
    steep.inputs[1].default_value = radians(EDGE_DEGREES)
    edges.domain = "EDGE"
    edges.inputs["Shade Smooth"].default_value = False
    colour.inputs["Material"].default_value = made
    for source, target in ((first.outputs[0], edges.inputs[0]),
                           (angle.outputs["Unsigned Angle"], steep.inputs[0]), (steep.outputs[0], edges.inputs["Selection"]),
                           (edges.outputs[0], colour.inputs["Geometry"]), (colour.outputs[0], last.inputs[0])):
        tree.links.new(source, target)


def surroundings(surface):
    """A floor, a sun, a sky, and a camera that has all of the water in view."""
    corners = [surface.matrix_world @ Vector(corner) for corner in surface.bound_box]
    low = Vector(min(corner[axis] for corner in corners) for axis in range(3))
    high = Vector(max(corner[axis] for corner in corners) for axis in range(3))
    middle, size = (low + high) / 2, high - low
    bpy.ops.mesh.primitive_plane_add(size=200, location=(middle.x, middle.y, low.z - 0.02))
    dress(bpy.context.object, material("Ground", GROUND, 0.8)[0])
    bpy.ops.object.light_add(type="SUN", rotation=(radians(35), radians(15), radians(40)))
    bpy.context.object.data.energy = 4
    bpy.context.object.data.angle = radians(3)
    world = bpy.context.scene.world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.75, 0.86, 1, 1)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.7
    away = Vector((0.25, -1, 0.55)).normalized() * size.length * 1.32
    bpy.ops.object.camera_add(location=middle + away)
    camera = bpy.context.scene.camera = bpy.context.object
    camera.rotation_euler = (-away).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens = 44


def main(water, body, time, picture):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    surface, bodies = import_swim(str(Path(water).resolve()), str(Path(body).resolve()))
    dress_water(surface, water_material())
    skin, _ = material("Body", SKIN, 0.35)
    for one in bodies:
        dress(one, skin)
    scene = bpy.context.scene
    scene.frame_set(round(float(time) * FRAMES_PER_SECOND))
    surroundings(surface)
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_denoising = True
    scene.cycles.max_bounces = scene.cycles.transmission_bounces = 16
    scene.view_settings.view_transform = "AgX"
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.filepath = str(Path(picture).resolve())
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(picture).resolve().with_suffix(".blend")))
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 if "--" in sys.argv else 1:])
