# Renders a scene of this bench with Cycles: once with all light, in two independent halves, and once where
# nothing occludes. Run by `blender -b --factory-startup -P render_scene.py -- JOB.json`; cycles.cpp writes the
# job.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import json
import os
import sys
import traceback

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import camera
import float_map
import gltf_source
import lights
import materials

# Radiance that no path exceeds after its first bounce: rarer and brighter samples would be noise that no
# number of samples removes. As in the path tracer of tests/reference.
CLAMP = 20


numpy.bool = bool  # the importer of Blender 3.4 takes it from there, where NumPy 1.24 no longer has it


def import_scene(job):
    """Fill the scene with the source, its lights and materials."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    prepared = os.path.join(bpy.app.tempdir, "source.glb")
    source_lights = gltf_source.prepare(job["source"], prepared)
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    bpy.ops.import_scene.gltf(filepath=prepared, import_pack_images=False)
    lamps = []
    for lamp in [item for item in bpy.data.objects if item.type == "LIGHT"]:
        source = source_lights[int(lamp.data.name.split("_")[1].split(".")[0])]
        lights.set_light(lamp.data, source, job["exposure"])
        if source["type"] != "directional":
            lamps.append(lamp.matrix_world.translation.copy())
    for light in job["added_lights"]:
        lights.add_light(light, light["position"], light["direction"])
    for material in bpy.data.materials:
        if material.use_nodes:
            materials.rebuild(material, job["exposure"], lamps)
    give_default_material()


def give_default_material():
    """glTF's default material is a white metal of roughness 1."""
    default = None
    for item in bpy.data.objects:
        if item.type == "MESH" and not [slot for slot in item.material_slots if slot.material]:
            default = default or materials.make_plain((1, 1, 1), 1, 1)
            item.data.materials.clear()
            item.data.materials.append(default)


def set_occluding(is_occluding):
    for item in bpy.data.objects:
        if item.type == "MESH":
            item.visible_shadow = item.visible_diffuse = item.visible_glossy = is_occluding
            item.visible_transmission = is_occluding
    camera.set_bounces(12 if is_occluding else 1)


def render_open(job, sky):
    """Render light that nothing occludes: objects are seen by the camera alone.

    Occlusion textures dim the light of the sky, as glTF has it.
    """
    set_occluding(False)
    if not any(materials.find_occlusion(material) for material in bpy.data.materials if material.use_nodes):
        camera.render_to(job["open"], job["open_samples"], 1)
        return
    materials.set_sky_alone(True)
    lamps = [item for item in bpy.data.objects if item.type == "LIGHT"]
    for lamp in lamps:
        lamp.hide_render = True
    under_sky = camera.render(job["open_samples"], 1)
    for lamp in lamps:
        lamp.hide_render = False
    materials.set_sky_alone(False)
    lights.set_sky(None)
    float_map.write(job["open"], under_sky + camera.render(job["open_samples"], 1))
    lights.set_sky(sky)


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        job = json.load(file)
    import_scene(job)
    sky = float_map.read(job["sky"])
    lights.set_sky(sky)
    camera.set_camera(**job["camera"])
    camera.set_image(job["width"], job["height"])
    render_open(job, sky)
    set_occluding(True)
    for seed, path in enumerate(job["full"]):
        camera.render_to(path, job["full_samples"] // len(job["full"]), seed + 1, CLAMP)


try:
    main()
except Exception:  # Blender would end with 0
    traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(1)
