/* Calls hearth.h from C99 with a Vulkan device of its own, like a game.
 * SPDX-License-Identifier: LicenseRef-Hearth-Undecided */
#ifndef HEARTH_TESTS_C_CALLER_H
#define HEARTH_TESTS_C_CALLER_H

#include "runtime/c/hearth.h"

typedef struct c_caller c_caller;

/* Returns NULL if there is no Vulkan device of this name, or no validation layer. */
c_caller* c_caller_create(const char* device_name);
void c_caller_destroy(c_caller* caller);

/* Description with all that hearth_renderer_create needs. */
hearth_renderer_description c_caller_description(const c_caller* caller);

/* Messages of the validation layer so far, and the first of them. */
unsigned c_caller_message_count(const c_caller* caller);
const char* c_caller_message(const c_caller* caller);

/* Device memory from the caller, one allocation for each request; counts of live and of all allocations. */
hearth_memory_hooks c_caller_memory(c_caller* caller);
unsigned c_caller_live_pieces(const c_caller* caller);
unsigned c_caller_all_pieces(const c_caller* caller);

/* Begins a command buffer; c_caller_submit submits it and waits, c_caller_discard discards it. */
VkCommandBuffer c_caller_begin(c_caller* caller);
VkResult c_caller_submit(c_caller* caller);
VkResult c_caller_discard(c_caller* caller);

/* Copies a color image of targets whose last frame has completed; pixels has width * height words. */
VkResult c_caller_read_color(c_caller* caller, const hearth_image* color, uint32_t width, uint32_t height,
                             uint32_t* pixels);

/* An image: its inputs and, after drawing, its results. */
typedef struct c_image
{
    hearth_scene_options scene;
    hearth_frame frame; /* its timestamps are set */
    uint32_t width, height;
    int in_parts;           /* record the frame in three parts */
    uint32_t targets_flags; /* HEARTH_TARGETS_*, beside KEEP_VISIBILITY */
    const hearth_image* colors; /* images that the frame may show: it shows the first; or NULL */
    uint32_t color_count;

    uint32_t* color; /* width * height, the caller's array; also below */
    uint32_t* visibility;
    hearth_pick* picks;         /* or NULL */
    float* depth;               /* or NULL; needs HEARTH_FEATURE_DEPTH */
    uint32_t* motion;           /* or NULL: two halves a pixel; needs the flags of motion vectors */
    const hearth_frame* before; /* or NULL: is drawn first, with the same targets */
    uint64_t ticks[HEARTH_TIMESTAMP_COUNT];
    hearth_frame_counters counters;
    hearth_stream_counters streaming; /* with a budget */
} c_image;

/* Uploads the scene, with a budget streams it until all requested pages are there, and draws one frame. */
hearth_result c_caller_draw(c_caller* caller, hearth_renderer* renderer, hearth_pack* pack, c_image* image);

#endif
