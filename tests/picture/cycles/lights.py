# Bridges Hearth's photometric units to Cycles: one unit of radiance there is one here, after the exposure
# that Hearth chooses, and the sky is an image by direction. closed_forms.py checks all of it.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import math

import bpy
from mathutils import Matrix, Vector

# glTF has Y up, Blender Z
BLENDER_FROM_GLTF = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def from_gltf(vector):
    return BLENDER_FROM_GLTF.to_3x3() @ Vector(vector)


def use_nodes(light):
    """Return the node tree of a light and its emission node, of strength 1."""
    light.use_nodes = True
    tree = light.node_tree
    return tree, next(node for node in tree.nodes if node.type == "EMISSION")


def math_node(tree, operation, *operands, clamp=False):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    node.use_clamp = clamp
    for socket, operand in zip(node.inputs, operands):
        if isinstance(operand, (int, float)):
            socket.default_value = operand
        else:
            tree.links.new(operand, socket)
    return node.outputs[0]


def retype(light, kind):
    """Return the light as one of another kind, which is another object of Python."""
    light.type = kind
    return bpy.data.lights[light.name]


def set_sun(light, color, lux):
    """lux  illuminance of a surface that faces the sun; Blender has W/m2 there"""
    light = retype(light, "SUN")
    light.color = color
    light.energy = lux
    light.angle = 0


def set_point(light, color, candela):
    """Blender has the power of a sphere of radius 0, of which 1 / (4 pi) leaves in each steradian."""
    light = retype(light, "POINT")
    light.color = color
    light.energy = candela * 4 * math.pi
    light.shadow_soft_size = 0
    return light


def set_range(light, metres):
    """Window of KHR_lights_punctual, "Range Property": clamp(1 - (distance / range)^4)."""
    tree, emission = use_nodes(light)
    path = tree.nodes.new("ShaderNodeLightPath")
    part = math_node(tree, "DIVIDE", path.outputs["Ray Length"], metres)
    window = math_node(tree, "SUBTRACT", 1, math_node(tree, "POWER", part, 4), clamp=True)
    multiply_strength(tree, emission, window)


def set_cone(light, inner, outer):
    """Make a point light a spot along -Z of its object: squared and linear between the cosines, as
    KHR_lights_punctual, "Inner and Outer Cone Angles", has it. Blender's own spots blend otherwise."""
    tree, emission = use_nodes(light)
    direction = tree.nodes.new("ShaderNodeTexCoord").outputs["Normal"]
    separate = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(direction, separate.inputs[0])
    cosine = math_node(tree, "MULTIPLY", separate.outputs["Z"], -1)
    low, high = math.cos(outer), math.cos(inner)
    above = math_node(tree, "SUBTRACT", cosine, low)
    inside = math_node(tree, "DIVIDE", above, max(0.001, high - low), clamp=True)
    multiply_strength(tree, emission, math_node(tree, "POWER", inside, 2))


def multiply_strength(tree, emission, factor):
    strength = emission.inputs["Strength"]
    before = strength.links[0].from_socket if strength.is_linked else strength.default_value
    tree.links.new(math_node(tree, "MULTIPLY", before, factor), strength)


def set_light(light, source, exposure):
    """Set a light of Blender from one of KHR_lights_punctual."""
    color = source.get("color", [1, 1, 1])
    intensity = source.get("intensity", 1) * exposure
    if source["type"] == "directional":
        set_sun(light, color, intensity)
        return
    light = set_point(light, color, intensity)
    if source["type"] == "spot":
        cone = source.get("spot", {})
        set_cone(light, cone.get("innerConeAngle", 0), cone.get("outerConeAngle", math.pi / 4))
    if source.get("range"):
        set_range(light, source["range"])


def add_light(source, position, direction, exposure=1):
    """Add a light at a position of glTF space.

    direction  in which it shines
    """
    light = bpy.data.lights.new("light", "POINT")
    set_light(light, source, exposure)
    lamp = bpy.data.objects.new("light", light)
    lamp.location = from_gltf(position)
    lamp.rotation_mode = "QUATERNION"
    lamp.rotation_quaternion = from_gltf(direction).to_track_quat("-Z", "Y")
    bpy.context.scene.collection.objects.link(lamp)
    return lamp


def set_sky(pixels):
    """Light the scene by an image of the sky.

    pixels  (height, width, 3), first row towards -Y of glTF, last row +Y; None: black
    """
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    if pixels is None:
        background.inputs["Strength"].default_value = 0
        return
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("sky", width, height, float_buffer=True, is_data=True)
    rgba = [1.0] * (width * height * 4)
    for channel in range(3):
        rgba[channel::4] = pixels[:, :, channel].ravel().tolist()
    image.pixels.foreach_set(rgba)
    image.update()
    image.pack()
    texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    texture.interpolation = "Linear"
    world.node_tree.links.new(texture.outputs[0], background.inputs["Color"])
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = 512
