# Sets camera, image and sampling of Cycles, and renders to float images.
# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import os

import bpy
import numpy
from mathutils import Matrix

import float_map
from lights import from_gltf


def set_camera(position, target, up, y_fov_rad, z_near):
    """All vectors in glTF space."""
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = y_fov_rad
    camera.clip_start = z_near
    camera.clip_end = 1e6
    eye, forward = from_gltf(position), (from_gltf(target) - from_gltf(position)).normalized()
    right = forward.cross(from_gltf(up)).normalized()
    axes = Matrix((right, right.cross(forward), -forward)).transposed().to_4x4()
    viewer = bpy.data.objects.new("camera", camera)
    viewer.matrix_world = Matrix.Translation(eye) @ axes
    bpy.context.scene.collection.objects.link(viewer)
    bpy.context.scene.camera = viewer


def set_image(width, height):
    render = bpy.context.scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.use_compositing = render.use_sequencer = False
    render.dither_intensity = 0
    cycles = bpy.context.scene.cycles
    cycles.device = "CPU"
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.light_sampling_threshold = 0  # no lamp is too dim
    cycles.blur_glossy = 0
    cycles.sample_clamp_direct = 0
    cycles.transparent_max_bounces = 64


def set_bounces(bounces):
    cycles = bpy.context.scene.cycles
    cycles.max_bounces = cycles.diffuse_bounces = bounces
    cycles.glossy_bounces = cycles.transmission_bounces = bounces


def render(samples, seed, clamp_indirect=0):
    """Return linear radiance, (height, width, 3), first row at the bottom.

    clamp_indirect  radiance that no path beyond the first bounce exceeds; 0: none
    """
    scene = bpy.context.scene
    scene.cycles.samples = samples
    scene.cycles.seed = seed
    scene.cycles.sample_clamp_indirect = clamp_indirect
    path = os.path.join(bpy.app.tempdir, "image.exr")
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    rgba = numpy.empty(image.size[0] * image.size[1] * 4, numpy.float32)
    image.pixels.foreach_get(rgba)
    pixels = rgba.reshape(image.size[1], image.size[0], 4)[:, :, :3].copy()
    bpy.data.images.remove(image)
    return pixels


def render_to(path, samples, seed, clamp_indirect=0):
    float_map.write(path, render(samples, seed, clamp_indirect))
