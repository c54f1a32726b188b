# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""draw_image.py PACK.hearth OUT.ppm: draws a pack without a window, from its first camera or, if it has none,
from one that shows the whole scene."""
import contextlib
import ctypes
import sys

import hearth

WIDTH, HEIGHT = 640, 480


def choose_camera(pack, scene):
    if hearth.pack_get_count(pack, hearth.TABLE_CAMERAS) > 0:
        camera = hearth.pack_get_camera(pack, 0)
        if camera.type == hearth.CAMERA_PERSPECTIVE:
            return camera.view
    info = hearth.scene_get_info(scene)
    return hearth.fit_camera(info.box_min, info.box_max, WIDTH / HEIGHT)


def draw(path):
    """Return the texels, RGBA in sRGB, rows from top to bottom."""
    with contextlib.ExitStack() as stack:  # destroys in the opposite order
        pack = hearth.pack_open(path)
        stack.callback(hearth.pack_close, pack)
        device = hearth.device_create(hearth.DeviceOptions())
        stack.callback(hearth.device_destroy, device)
        renderer = hearth.renderer_create(hearth.device_describe(device))
        stack.callback(hearth.renderer_destroy, renderer)

        commands = hearth.device_begin(device)
        options = hearth.SceneOptions(flags=hearth.SCENE_DECODE_TEXTURES)  # draws packs for phones, too
        scene = hearth.scene_upload(renderer, pack, commands, options)
        stack.callback(hearth.scene_destroy, scene)
        hearth.device_submit(device)
        hearth.scene_release_staging(scene)

        size = hearth.TargetsDescription(width=WIDTH, height=HEIGHT, scene=scene)
        targets = hearth.targets_create(renderer, size)
        stack.callback(hearth.targets_destroy, targets)
        frame = hearth.Frame(camera=choose_camera(pack, scene))
        commands = hearth.device_begin(device)
        hearth.record_frame(scene, targets, commands, frame)
        hearth.device_submit(device)
        texels = ctypes.create_string_buffer(WIDTH * HEIGHT * 4)
        image = hearth.targets_get_info(targets).color
        hearth.device_read_image(device, image, WIDTH, HEIGHT, texels, len(texels))
        return texels.raw


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: draw_image.py PACK.hearth OUT.ppm")
    try:
        texels = draw(sys.argv[1])
    except hearth.Error as error:
        sys.exit(f"draw_image.py: {error}")
    colors = bytearray(WIDTH * HEIGHT * 3)
    for channel in range(3):
        colors[channel::3] = texels[channel::4]
    with open(sys.argv[2], "wb") as file:
        file.write(b"P6 %d %d 255\n" % (WIDTH, HEIGHT) + colors)


if __name__ == "__main__":
    main()
