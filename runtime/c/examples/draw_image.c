/* draw_image PACK.hearth OUT.png: draws a pack without a window, from its first camera, or from one that
 * shows the whole scene.
 * SPDX-License-Identifier: LicenseRef-Hearth-Undecided */
#include <hearth_helpers.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>

#define WIDTH 640
#define HEIGHT 480

static unsigned char pixels[WIDTH * HEIGHT * 4]; /* RGBA, sRGB, rows from top to bottom */

/* Exit if a call failed. */
static void check(hearth_result result, const char* message)
{
    if (result == HEARTH_OK)
        return;
    fprintf(stderr, "draw_image: %s\n", message[0] == '\0' ? hearth_result_string(result) : message);
    exit(1);
}

static hearth_camera choose_camera(const hearth_pack* pack, const hearth_scene* scene)
{
    hearth_pack_camera camera = HEARTH_PACK_CAMERA_INIT;
    hearth_scene_info info = HEARTH_SCENE_INFO_INIT;
    if (hearth_pack_get_camera(pack, 0, &camera, NULL, 0) == HEARTH_OK &&
        camera.type == HEARTH_CAMERA_PERSPECTIVE)
        return camera.view;
    check(hearth_scene_get_info(scene, &info), "");
    return hearth_fit_camera(info.box_min, info.box_max, (float)WIDTH / HEIGHT);
}

/* Upload the pack, and draw one frame into `pixels`. */
static void draw(hearth_device* device, hearth_renderer* renderer, hearth_pack* pack)
{
    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    hearth_targets_description size = HEARTH_TARGETS_DESCRIPTION_INIT;
    hearth_targets_info images = HEARTH_TARGETS_INFO_INIT;
    hearth_frame frame = HEARTH_FRAME_INIT;
    hearth_scene* scene = NULL;
    hearth_targets* targets = NULL;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(hearth_device_begin(device, &commands), hearth_device_last_error(device));
    options.flags = HEARTH_SCENE_DECODE_TEXTURES; /* draws packs for phones on any device */
    check(hearth_scene_upload(renderer, pack, commands, &options, &scene), hearth_last_error(renderer));
    check(hearth_device_submit(device), hearth_device_last_error(device));
    check(hearth_scene_release_staging(scene), hearth_last_error(renderer));

    size.width = WIDTH;
    size.height = HEIGHT;
    size.scene = scene;
    check(hearth_targets_create(renderer, &size, &targets), hearth_last_error(renderer));
    check(hearth_targets_get_info(targets, &images), hearth_last_error(renderer));
    frame.camera = choose_camera(pack, scene);
    check(hearth_device_begin(device, &commands), hearth_device_last_error(device));
    check(hearth_record_frame(scene, targets, commands, &frame), hearth_last_error(renderer));
    check(hearth_device_submit(device), hearth_device_last_error(device));
    check(hearth_device_read_image(device, &images.color, WIDTH, HEIGHT, pixels, sizeof(pixels)),
          hearth_device_last_error(device));
    hearth_targets_destroy(targets);
    hearth_scene_destroy(scene);
}

static void write_png(const char* path)
{
    png_image image = {0};
    image.version = PNG_IMAGE_VERSION;
    image.width = WIDTH;
    image.height = HEIGHT;
    image.format = PNG_FORMAT_RGBA;
    if (!png_image_write_to_file(&image, path, 0, pixels, 0, NULL))
        check(HEARTH_ERROR_USAGE, image.message);
}

int main(int argument_count, char** arguments)
{
    const hearth_device_options options = HEARTH_DEVICE_OPTIONS_INIT;
    hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
    hearth_device* device = NULL;
    hearth_renderer* renderer = NULL;
    hearth_pack* pack = NULL;
    char message[512] = "";
    if (argument_count != 3)
        check(HEARTH_ERROR_USAGE, "usage: draw_image PACK.hearth OUT.png");
    check(hearth_pack_open(arguments[1], &pack, message, sizeof(message)), message);
    check(hearth_device_create(&options, &device, message, sizeof(message)), message);
    check(hearth_device_describe(device, &description), hearth_device_last_error(device));
    check(hearth_renderer_create(&description, &renderer, message, sizeof(message)), message);
    draw(device, renderer, pack);
    write_png(arguments[2]);
    hearth_renderer_destroy(renderer);
    hearth_device_destroy(device);
    hearth_pack_close(pack);
    return 0;
}
