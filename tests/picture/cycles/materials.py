# Builds the metallic-roughness material of glTF 2.0, appendix B, from Cycles' closures, in place of the
# Principled BSDF of Blender's importer, which has Disney's diffuse lobe and reflects more light than arrives.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import math

import bpy
import numpy

from lights import math_node

IOR = 1.5  # of all dielectrics
DIELECTRIC_F0 = ((IOR - 1) / (IOR + 1)) ** 2
MIN_ROUGHNESS = 0.045  # below, highlights of lamps without a size are narrower than a sample
LAMP_RADIUS = 0.05  # metres: surfaces that near to a lamp are a part of it, and do not shadow it
TABLE_SIZE = 64
SKY_SWITCH = "SKY_SWITCH"  # name of a node


def fresnel(cosine):
    """Return the share of unpolarised light that a dielectric reflects, as Cycles has it."""
    refracted = numpy.sqrt(1 - (1 - cosine * cosine) / (IOR * IOR))
    across = (cosine - IOR * refracted) / (cosine + IOR * refracted)
    along = (IOR * cosine - refracted) / (IOR * cosine + refracted)
    return (across * across + along * along) / 2


def integrate_lobe(roughness, n_dot_v):
    """Return the share of constant light that a dielectric GGX lobe of height-correlated masking reflects."""
    alpha = roughness * roughness
    count = 256
    # half vectors by their own distribution: the density of directions is D n.h / (4 v.h)
    u, phi = (numpy.arange(count) + 0.5) / count, (numpy.arange(64) + 0.5) / 64 * 2 * math.pi
    u, phi = numpy.meshgrid(u, phi)
    n_dot_h = numpy.sqrt((1 - u) / (1 + (alpha * alpha - 1) * u))
    sine = numpy.sqrt(1 - n_dot_h * n_dot_h)
    v_dot_h = math.sqrt(1 - n_dot_v * n_dot_v) * sine * numpy.cos(phi) + n_dot_v * n_dot_h
    n_dot_l = 2 * v_dot_h * n_dot_h - n_dot_v
    is_lit = (v_dot_h > 0) & (n_dot_l > 0)
    v_dot_h, n_dot_l, n_dot_h = v_dot_h[is_lit], n_dot_l[is_lit], n_dot_h[is_lit]
    a2 = alpha * alpha
    smith = 0.5 / (n_dot_l * numpy.sqrt(n_dot_v * n_dot_v * (1 - a2) + a2)
                   + n_dot_v * numpy.sqrt(n_dot_l * n_dot_l * (1 - a2) + a2))
    return float((4 * fresnel(v_dot_h) * smith * n_dot_l * v_dot_h / n_dot_h).sum() / u.size)


def dielectric_table():
    """Return an image of the dielectric lobe's share: root of n.v to the right, roughness upwards."""
    name = "dielectric"
    if name in bpy.data.images:
        return bpy.data.images[name]
    image = bpy.data.images.new(name, TABLE_SIZE, TABLE_SIZE, float_buffer=True, is_data=True)
    steps = (numpy.arange(TABLE_SIZE) + 0.5) / TABLE_SIZE
    rgba = numpy.ones((TABLE_SIZE, TABLE_SIZE, 4), numpy.float32)
    for row, roughness in enumerate(steps):
        for column, root in enumerate(steps):
            rgba[row, column, :3] = integrate_lobe(max(roughness, MIN_ROUGHNESS), root * root)
    image.pixels.foreach_set(rgba.ravel())
    image.update()
    image.pack()
    return image


class Graph:
    """Node tree of a material. Sockets and plain values may be mixed."""

    def __init__(self, tree):
        self.tree = tree

    def node(self, kind, **inputs):
        node = self.tree.nodes.new(kind)
        for name, value in inputs.items():
            self.connect(value, node.inputs[name.replace("_", " ")])
        return node

    def connect(self, value, socket):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, *operands, clamp=False):
        return math_node(self.tree, operation, *operands, clamp=clamp)

    def dot(self, a, b):
        node = self.tree.nodes.new("ShaderNodeVectorMath")
        node.operation = "DOT_PRODUCT"
        self.tree.links.new(a, node.inputs[0])
        self.tree.links.new(b, node.inputs[1])
        return node.outputs["Value"]

    def scaled(self, color, factor):
        """A colour times a number."""
        node = self.tree.nodes.new("ShaderNodeVectorMath")
        node.operation = "SCALE"
        self.connect(color[:3] if isinstance(color, tuple) else color, node.inputs[0])
        self.connect(factor, node.inputs["Scale"])
        return node.outputs[0]

    def mix(self, share, first, second):
        node = self.tree.nodes.new("ShaderNodeMixShader")
        self.connect(share, node.inputs[0])
        self.tree.links.new(first, node.inputs[1])
        self.tree.links.new(second, node.inputs[2])
        return node.outputs[0]

    def add(self, first, second):
        node = self.tree.nodes.new("ShaderNodeAddShader")
        self.tree.links.new(first, node.inputs[0])
        self.tree.links.new(second, node.inputs[1])
        return node.outputs[0]


def dielectric_share(graph, roughness, normal):
    geometry = graph.node("ShaderNodeNewGeometry")
    normal = normal or geometry.outputs["Normal"]
    n_dot_v = graph.math("ABSOLUTE", graph.dot(geometry.outputs["Incoming"], normal))
    place = graph.node("ShaderNodeCombineXYZ", X=graph.math("SQRT", n_dot_v), Y=roughness)
    table = graph.node("ShaderNodeTexImage", Vector=place.outputs[0])
    table.image = dielectric_table()
    table.extension = "EXTEND"
    return table.outputs["Color"]


def reflecting(graph, base, metallic, roughness, normal):
    """Return a shader: Lambert's law below a dielectric GGX lobe, mixed with a metallic one.

    The metallic lobe scatters several times. The dielectric one would add at most 0.002 by that, and Cycles
    samples it wrongly beside another lobe.
    """

    def lobe(distribution, **inputs):
        node = graph.node("ShaderNodeBsdfPrincipled", Roughness=roughness, **inputs)
        node.distribution = distribution
        node.inputs["Specular"].default_value = DIELECTRIC_F0 / 0.08
        if normal:
            graph.connect(normal, node.inputs["Normal"])
        return node.outputs[0]

    left = graph.math("SUBTRACT", 1, dielectric_share(graph, roughness, normal))
    diffuse = graph.node("ShaderNodeBsdfDiffuse", Color=graph.scaled(base, left))
    if normal:
        graph.connect(normal, diffuse.inputs["Normal"])
    dielectric = graph.add(diffuse.outputs[0], lobe("GGX", Base_Color=(0, 0, 0, 1), Metallic=0.0))
    metal = lobe("MULTI_GGX", Base_Color=base, Metallic=1.0)
    return graph.mix(metallic, dielectric, metal)


def near_lamp(graph, lamps):
    """1 within LAMP_RADIUS of a lamp.

    lamps  positions, at least one
    """
    position = graph.node("ShaderNodeNewGeometry").outputs["Position"]
    result = 0.0
    for lamp in lamps:
        distance = graph.tree.nodes.new("ShaderNodeVectorMath")
        distance.operation = "DISTANCE"
        graph.connect(position, distance.inputs[0])
        graph.connect(tuple(lamp), distance.inputs[1])
        is_near = graph.math("LESS_THAN", distance.outputs["Value"], LAMP_RADIUS)
        result = graph.math("MAXIMUM", result, is_near)
    return result


def unless(graph, hidden, shader):
    """Let rays through where `hidden` is 1."""
    return graph.mix(hidden, shader, graph.node("ShaderNodeBsdfTransparent").outputs[0])


def invert_tone_curve(graph, color):
    """Return the radiance that the tone curve shows as a colour below 0.999."""
    parts = graph.tree.nodes.new("ShaderNodeSeparateColor")
    graph.connect(color, parts.inputs[0])
    joined = graph.tree.nodes.new("ShaderNodeCombineColor")
    for channel in range(3):
        y = graph.math("POWER", graph.math("MINIMUM", parts.outputs[channel], 0.999), 1 / 2.2)
        # 6.2 (1 - y) x^2 + (0.5 - 1.7 y) x - 0.06 y = 0
        a = graph.math("MULTIPLY", graph.math("SUBTRACT", 1, y), 6.2)
        b = graph.math("SUBTRACT", 0.5, graph.math("MULTIPLY", y, 1.7))
        root = graph.math("SQRT", graph.math("ADD", graph.math("MULTIPLY", b, b),
                                             graph.math("MULTIPLY", graph.math("MULTIPLY", a, y), 0.24)))
        x = graph.math("DIVIDE", graph.math("SUBTRACT", root, b), graph.math("MULTIPLY", a, 2))
        graph.connect(graph.math("ADD", x, 0.004), joined.inputs[channel])
    return joined.outputs[0]


def make_material(name):
    """Return a new material's graph without nodes, and the material."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return Graph(material.node_tree), material


def show(graph, shader):
    """Make a shader the material's surface."""
    output = next((node for node in graph.tree.nodes if node.type == "OUTPUT_MATERIAL"), None)
    output = output or graph.tree.nodes.new("ShaderNodeOutputMaterial")
    graph.tree.links.new(shader, output.inputs["Surface"])


def make_plain(base, metallic, roughness, emission=(0, 0, 0), strength=1.0, exposure=1.0):
    """Return a material without textures."""
    graph, material = make_material("plain")
    shader = reflecting(graph, (*base, 1), metallic, max(roughness, MIN_ROUGHNESS), None)
    glow = graph.node("ShaderNodeEmission", Color=(*emission, 1), Strength=strength * exposure)
    show(graph, graph.add(shader, glow.outputs[0]))
    return material


def make_unlit_plain(base):
    graph, material = make_material("unlit")
    emission = graph.node("ShaderNodeEmission", Color=invert_tone_curve(graph, (*base, 1)))
    show(graph, emission.outputs[0])
    return material


def source_of(socket):
    """Return the socket that feeds an input, or the input's own value."""
    if socket.is_linked:
        source = socket.links[0].from_socket
        if source.node.bl_idname == "ShaderNodeMix" and source.node.data_type == "RGBA":
            return source.node.outputs[2]  # Blender 3.4 links emission to the mix of numbers, which is 0.5
        return source
    value = socket.default_value
    return value if isinstance(value, float) else tuple(value)


def find_node(tree, kind):
    return next((node for node in tree.nodes if node.type == kind), None)


def holes(graph, material, alpha):
    """Return where a surface is not there: holes of masks; blended surfaces end at one half."""
    cutoff = material.alpha_threshold if material.blend_method == "CLIP" else 0.5
    return graph.math("LESS_THAN", alpha, cutoff)


def add_sky_switch(graph):
    """Return a number of a material that set_sky_alone() sets: 1 for the light of the sky alone, else 0."""
    switch = graph.node("ShaderNodeValue")
    switch.name = SKY_SWITCH
    return switch.outputs[0]


def set_sky_alone(is_alone):
    """Show the light of the sky alone, which occlusion textures dim, without emission."""
    for material in bpy.data.materials:
        if material.use_nodes and SKY_SWITCH in material.node_tree.nodes:
            material.node_tree.nodes[SKY_SWITCH].outputs[0].default_value = float(is_alone)


def rebuild_lit(material, exposure, lamps):
    tree = material.node_tree
    graph, imported = Graph(tree), find_node(tree, "BSDF_PRINCIPLED")
    value = {name: source_of(imported.inputs[name])
             for name in ("Base Color", "Metallic", "Roughness", "Emission", "Emission Strength", "Alpha")}
    normal = source_of(imported.inputs["Normal"]) if imported.inputs["Normal"].is_linked else None
    roughness = graph.math("MAXIMUM", value["Roughness"], MIN_ROUGHNESS)
    shader = reflecting(graph, value["Base Color"], value["Metallic"], roughness, normal)
    sky_alone = add_sky_switch(graph)
    occlusion = find_occlusion(material)
    if occlusion:
        share = graph.math("MAXIMUM", occlusion, graph.math("SUBTRACT", 1, sky_alone))
        black = graph.node("ShaderNodeBsdfDiffuse", Color=(0, 0, 0, 1))
        shader = graph.mix(share, black.outputs[0], shader)
    path, geometry = graph.node("ShaderNodeLightPath"), graph.node("ShaderNodeNewGeometry")
    strength = graph.math("MULTIPLY", value["Emission Strength"], exposure)
    strength = graph.math("MULTIPLY", strength, graph.math("SUBTRACT", 1, sky_alone))
    back = 0.0
    if material.use_backface_culling:
        strength = graph.math("MULTIPLY", strength, graph.math("SUBTRACT", 1, geometry.outputs["Backfacing"]))
        # back faces are not seen, and hide light all the same
        back = graph.math("MULTIPLY", geometry.outputs["Backfacing"],
                          graph.math("SUBTRACT", 1, path.outputs["Is Shadow Ray"]))
    if shines(imported):
        glow = graph.node("ShaderNodeEmission", Color=value["Emission"], Strength=strength)
        shader = graph.add(shader, glow.outputs[0])
    hidden = back
    if material.blend_method != "OPAQUE":
        hidden = graph.math("MAXIMUM", hidden, holes(graph, material, value["Alpha"]))
    if lamps:
        hidden = graph.math("MAXIMUM", hidden, graph.math("MULTIPLY", near_lamp(graph, lamps),
                                                          path.outputs["Is Shadow Ray"]))
    tree.nodes.remove(imported)
    show(graph, unless(graph, hidden, shader) if hidden != 0.0 else shader)


def shines(principled):
    color, strength = principled.inputs["Emission"], principled.inputs["Emission Strength"]
    has_color = color.is_linked or any(color.default_value[:3])
    return strength.is_linked or strength.default_value > 0 and has_color


def rebuild_unlit(material):
    """Unlit surfaces show their colour to the camera alone, and neither take nor give light."""
    graph, emission = Graph(material.node_tree), find_node(material.node_tree, "EMISSION")
    graph.connect(invert_tone_curve(graph, source_of(emission.inputs["Color"])), emission.inputs["Color"])
    graph.connect(graph.math("SUBTRACT", 1, add_sky_switch(graph)), emission.inputs["Strength"])


def rebuild(material, exposure, lamps):
    """Replace what the importer made of a glTF material.

    exposure  factor of emission
    lamps     positions of lamps, Blender space
    """
    if find_node(material.node_tree, "BSDF_PRINCIPLED"):
        rebuild_lit(material, exposure, lamps)
    elif find_node(material.node_tree, "EMISSION"):
        rebuild_unlit(material)


def find_occlusion(material):
    """Return the socket with the value of a material's occlusion texture, or None."""
    for node in material.node_tree.nodes:
        if node.type == "GROUP" and "Occlusion" in node.inputs and node.inputs["Occlusion"].is_linked:
            return node.inputs["Occlusion"].links[0].from_socket
    return None
