/* SPDX-License-Identifier: LicenseRef-Hearth-Undecided
 *
 * Optional helpers for tools, tests and first steps without a Vulkan device of their own: a headless device,
 * commands that run at once, image readback, a fitted camera. hearth.h does not need them; its rules hold
 * here too. examples/draw_image.c is a whole program.
 *
 * A static library in C99 that opens the Vulkan loader at run time. A device and everything made on it are
 * used by one thread at a time. */
#ifndef HEARTH_HELPERS_H
#define HEARTH_HELPERS_H

#include "hearth.h"

/* ---- Devices ---- */

/* Vulkan 1.1 instance and device, a queue for graphics and compute, and a command buffer. */
typedef struct hearth_device hearth_device;

typedef struct hearth_device_options
{
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    const char* name;  /* part of the device's name, in any case; NULL or "": the fastest kind available */
} hearth_device_options;

#define HEARTH_DEVICE_OPTIONS_INIT                                                                           \
    {                                                                                                        \
        sizeof(hearth_device_options), 0, NULL                                                               \
    }

/* errors: USAGE, OUT_OF_MEMORY; DEVICE if there is no Vulkan, or no device fits; DEVICE_FAILED, DEVICE_LOST,
 * OUT_OF_DEVICE_MEMORY. */
HEARTH_API hearth_result hearth_device_create(const hearth_device_options* options, hearth_device** device,
                                              char* message, size_t message_size);

/* Destroy a device without living objects: destroy the renderer before it. errors: none. */
HEARTH_API hearth_result hearth_device_destroy(hearth_device* device);

/* Return the message of the last failed call on the device; "" if none failed. Valid until the next call. */
HEARTH_API const char* hearth_device_last_error(const hearth_device* device);

typedef struct hearth_device_info
{
    uint32_t struct_size;
    uint32_t queue_family;
    VkQueue queue;
    VkPhysicalDevice physical_device;
    const char* name;     /* of the physical device; valid while the device lives */
    uint32_t is_software; /* 1: runs on the CPU, as lavapipe does; else 0 */
    uint32_t reserved;    /* 0 */
} hearth_device_info;

#define HEARTH_DEVICE_INFO_INIT                                                                              \
    {                                                                                                        \
        sizeof(hearth_device_info), 0, VK_NULL_HANDLE, VK_NULL_HANDLE, NULL, 0, 0                            \
    }

/* errors: USAGE. */
HEARTH_API hearth_result hearth_device_get_info(hearth_device* device, hearth_device_info* info);

/* Set the handles of a renderer's description, and HEARTH_FEATURE_SAMPLER_ANISOTROPY and
 * HEARTH_FEATURE_ASTC_HDR if the device has them; the rest stays. errors: USAGE. */
HEARTH_API hearth_result hearth_device_describe(hearth_device* device,
                                                hearth_renderer_description* description);

/* ---- Commands that run at once ---- */

/* Begin the device's command buffer, which hearth_device_submit or hearth_device_discard ends.
 * errors: USAGE, also if it has begun already; DEVICE_FAILED, DEVICE_LOST, OUT_OF_DEVICE_MEMORY. */
HEARTH_API hearth_result hearth_device_begin(hearth_device* device, VkCommandBuffer* commands);

/* Submit the commands recorded since hearth_device_begin, and wait until they have run.
 * errors: USAGE, also if nothing has begun; DEVICE_FAILED, DEVICE_LOST, OUT_OF_DEVICE_MEMORY. */
HEARTH_API hearth_result hearth_device_submit(hearth_device* device);

/* Discard the recorded commands, for example after a call that failed while recording.
 * errors: USAGE, also if nothing has begun; DEVICE_FAILED, DEVICE_LOST, OUT_OF_DEVICE_MEMORY. */
HEARTH_API hearth_result hearth_device_discard(hearth_device* device);

/* ---- Images and cameras ---- */

/* Read an image of targets, `color` or `visibility`, once its frame has run. Submits and waits.
 * width, height  of the targets
 * texels         4 bytes each, rows from top to bottom without gaps
 * size           bytes of `texels`: width * height * 4 or more
 * errors: USAGE, also between hearth_device_begin and its end; DEVICE if it has no host-visible memory;
 * DEVICE_FAILED, DEVICE_LOST, OUT_OF_DEVICE_MEMORY. */
HEARTH_API hearth_result hearth_device_read_image(hearth_device* device, const hearth_image* image,
                                                  uint32_t width, uint32_t height, void* texels, size_t size);

/* Return a camera that shows the whole box from the right, front and above.
 * box_min, box_max  metres; an empty box (of a scene without instances) counts as a cube around the origin
 * aspect            width / height of the frame, above 0 */
HEARTH_API hearth_camera hearth_fit_camera(const float box_min[3], const float box_max[3], float aspect);

#endif
