# Checks that light arrives in Cycles in Hearth's units: each light, the sky, emission and the camera beside a
# closed form. Run by `blender -b --factory-startup -P closed_forms.py -- REPORT.txt`; ends with 1 where one is
# wrong.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import math
import os
import sys

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import camera
import lights
import materials

TOLERANCE = 1e-4  # relative
HEIGHT = 2.0  # metres of a lamp above the plane
failures = 0
report = ""


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    lights.set_sky(None)
    camera.set_image(8, 8)
    camera.set_bounces(1)


def add_plane(material, half=1000.0, position=(0, 0, 0)):
    """Add a square that faces +Y of glTF."""
    bpy.ops.mesh.primitive_plane_add(size=2 * half, location=lights.from_gltf(position))
    bpy.context.object.data.materials.append(material)


def make_white():
    """Return a white diffuse material."""
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    return material


def look_at_origin(slant=0.0):
    """See 2 mm about the origin from straight above, or at a slant."""
    camera.set_camera((3 * math.sin(slant), 3 * math.cos(slant), 0), (0, 0, 0), (0, 0, -1), 0.0006, 0.01)


def compare(name, measured, expected, tolerance=TOLERANCE):
    global failures, report
    difference = measured / expected - 1
    is_equal = abs(difference) <= tolerance
    failures += not is_equal
    verdict = "" if is_equal else "  WRONG"
    report += "%-44s %.6f, closed form %.6f, %+.1e%s\n" % (name, measured, expected, difference, verdict)


def check(name, expected, samples=64, tolerance=TOLERANCE):
    compare(name, camera.render(samples, 1)[:, :, 1].mean(dtype=float), expected, tolerance)


def check_point():
    clear()
    add_plane(make_white())
    lights.add_light({"type": "point", "intensity": 6.0}, (0, HEIGHT, 0), (0, -1, 0), exposure=0.5)
    look_at_origin()
    check("point light of 3 cd, 2 m above a plane", 3 / HEIGHT**2 / math.pi)


def check_range():
    clear()
    add_plane(make_white())
    lights.add_light({"type": "point", "intensity": 3.0, "range": 2.5}, (0, HEIGHT, 0), (0, -1, 0))
    look_at_origin()
    check("the same with a range of 2.5 m", 3 / HEIGHT**2 / math.pi * (1 - (HEIGHT / 2.5) ** 4))


def check_spot():
    clear()
    add_plane(make_white())
    axis = (math.sin(0.35), -math.cos(0.35), 0)
    cone = {"innerConeAngle": 0.2, "outerConeAngle": 0.5}
    lights.add_light({"type": "spot", "intensity": 3.0, "spot": cone}, (0, HEIGHT, 0), axis)
    look_at_origin()
    inside = (math.cos(0.35) - math.cos(0.5)) / (math.cos(0.2) - math.cos(0.5))
    check("spot, seen between its cones", 3 / HEIGHT**2 / math.pi * inside**2)


def check_sun():
    clear()
    add_plane(make_white())
    lights.add_light({"type": "directional", "intensity": 2.0}, (0, 0, 0), (math.sin(1), -math.cos(1), 0))
    look_at_origin()
    check("sun of 2 lux, 1 rad from the zenith", 2 * math.cos(1) / math.pi)


def set_sky_of_heights(radiance):
    """Set a sky by its radiance at each height from -1 to 1, the sine of the elevation."""
    heights = numpy.sin((numpy.arange(4096) + 0.5) / 4096 * math.pi - math.pi / 2)
    lights.set_sky(numpy.repeat(radiance(heights)[:, None, None], 3, 2).repeat(8, 1))


def check_sky():
    clear()
    add_plane(make_white())
    set_sky_of_heights(lambda height: numpy.maximum(height, 0))
    look_at_origin()
    check("sky as bright as its height, plane", 2 / 3, samples=16384)  # its mean over the cosine lobe


def check_sky_below():
    """A plane does not see the sky below its horizon."""
    clear()
    add_plane(make_white())
    set_sky_of_heights(lambda height: numpy.where(height < 0, 1000.0, 0.001))
    look_at_origin()
    check("bright sky below the horizon, plane", 0.001)


def check_furnace():
    """A white surface in a white sky is white, whatever its material: dielectrics and metals."""
    # Cycles ends a metal's walk over microfacets early
    for metallic, tolerance in ((0.0, 0.002), (1.0, 0.03)):
        for roughness in (0.1, 0.5, 1.0):
            clear()
            add_plane(materials.make_plain((1, 1, 1), metallic, roughness))
            lights.set_sky(numpy.ones((4, 8, 3)))
            look_at_origin(0.8)
            check("white furnace, metallic %g, roughness %g" % (metallic, roughness), 1, 4096, tolerance)


def check_emission():
    clear()
    add_plane(materials.make_plain((0, 0, 0), 0, 1, emission=(0.5, 0.5, 0.5), strength=8, exposure=0.25))
    look_at_origin()
    check("emission of 4 nits at an exposure of 1/4", 1)


def check_unlit():
    """An unlit surface shows its base colour after the tone curve."""
    clear()
    add_plane(materials.make_unlit_plain((0.3, 0.3, 0.3)))
    look_at_origin()
    radiance = camera.render(4, 1)[4, 4, 1]
    x = radiance - 0.004
    shown = (x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06)) ** 2.2
    compare("unlit surface after the tone curve", shown, 0.3)


def check_camera():
    """A square that fills the right upper quarter of the image, and no more."""
    clear()
    camera.set_image(64, 32)
    camera.set_camera((0, 0, 5), (0, 0, 0), (0, 1, 0), 2 * math.atan(0.2), 0.01)
    bpy.ops.mesh.primitive_plane_add(
        size=1, location=lights.from_gltf((1, 0.5, 0)), rotation=(math.pi / 2, 0, 0))
    bpy.context.object.scale = (2, 1, 1)
    bpy.context.object.data.materials.append(
        materials.make_plain((0, 0, 0), 0, 1, emission=(1, 1, 1), strength=1, exposure=1))
    pixels = camera.render(16, 1)[:, :, 1]
    expected = numpy.zeros((32, 64))
    expected[16:, 32:] = 1
    right = int((abs(pixels - expected) < 0.01).sum())
    compare("pixels of a square that fills a quarter", right, expected.size)


for form in (check_point, check_range, check_spot, check_sun, check_sky, check_sky_below, check_emission,
             check_unlit, check_camera, check_furnace):
    form()
with open(sys.argv[sys.argv.index("--") + 1], "w", encoding="utf-8") as file:
    file.write(report)
os._exit(1 if failures else 0)  # Blender would end with 0
