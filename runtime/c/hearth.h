/* SPDX-License-Identifier: LicenseRef-Hearth-Undecided
 *
 * C API of the runtime: opens packs, uploads scenes, records frames into the caller's command buffers.
 * README.md has a whole program. Rules for every call:
 *
 * - The caller owns instance, device, queue, command buffers and their submission. The library submits
 *   nothing, waits for nothing, starts no thread, and has no globals. Vulkan 1.1 without optional features is
 *   enough.
 * - A call returns HEARTH_OK, or an error and has changed nothing. The message of an error is one line with a
 *   hint. hearth_last_error returns it; calls without a renderer write it to `message` (message_size bytes;
 *   may be NULL and 0). hearth_pack_last_error returns the message of hearth_pack_close. Only failed calls
 *   write messages. A call with a NULL handle leaves no message.
 * - Structs begin with their size, which the HEARTH_..._INIT macros set together with the defaults. Structs
 *   in arrays, and structs inside others, have no size and never change.
 * - A renderer and everything made from it are used by one thread at a time; hearth_read_done, and packs
 *   while they are open, by any number of threads. The library throws nothing; callbacks must not throw.
 * - Destroy objects before the object that they were made from, and after the frames that use them have
 *   completed. Destroying NULL does nothing.
 * - Calls that create objects, record or begin frames may fail with DEVICE_LOST, OUT_OF_DEVICE_MEMORY and
 *   OUT_OF_MEMORY. Without memory, the same call may be tried again. If a call that records fails, reset
 *   `commands` and record all of them again.
 * - After a loss, which the caller's submission may report first, nothing is in use any more: destroy scenes,
 *   targets and renderer, then the device, and make them again with another device. Packs, players and
 *   queries know no device: they stay.
 * - A file that is open as a pack must not be truncated or overwritten (write another one and rename it): it
 *   is mapped, and reading what is gone ends the process (SIGBUS). Packs in memory do not have that.
 * - Metres, radians, right-handed, +Y up. */
#ifndef HEARTH_H
#define HEARTH_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#ifdef __cplusplus
#define HEARTH_API extern "C" __attribute__((visibility("default")))
#else
#define HEARTH_API extern __attribute__((visibility("default")))
#endif

/* Major version << 16 | minor version. A library accepts callers of its major version, up to its minor
 * version. */
#define HEARTH_API_VERSION 0x00010008u

typedef int32_t hearth_result;
enum
{
    HEARTH_OK = 0,
    HEARTH_ERROR_USAGE = 1,            /* an argument, or the order of calls, breaks a rule of this header */
    HEARTH_ERROR_IN_USE = 2,           /* objects made from it are alive; the message counts them */
    HEARTH_ERROR_FILE_MISSING = 3,     /* a file does not exist or cannot be read */
    HEARTH_ERROR_FILE_MALFORMED = 4,   /* a file is damaged, of another kind or of another version */
    HEARTH_ERROR_READ = 5,             /* reading failed half way */
    HEARTH_ERROR_DEVICE = 6,           /* the device lacks what the renderer needs */
    HEARTH_ERROR_DEVICE_FAILED = 7,    /* a Vulkan call failed */
    HEARTH_ERROR_DEVICE_LIMIT = 8,     /* the scene or the frame is too large for the device */
    HEARTH_ERROR_STREAMING_BUDGET = 9, /* the pinned geometry exceeds the budget */
    HEARTH_ERROR_OUT_OF_MEMORY = 10,   /* CPU memory; of Vulkan: VK_ERROR_OUT_OF_HOST_MEMORY */
    HEARTH_ERROR_INTERNAL = 11,        /* a bug of Hearth */
    HEARTH_ERROR_DEVICE_LOST = 12,     /* 1.8: a Vulkan call returned VK_ERROR_DEVICE_LOST */
    /* 1.8: a Vulkan call or a memory hook returned VK_ERROR_OUT_OF_DEVICE_MEMORY */
    HEARTH_ERROR_OUT_OF_DEVICE_MEMORY = 13
};

typedef struct hearth_pack hearth_pack;
typedef struct hearth_renderer hearth_renderer;
typedef struct hearth_scene hearth_scene;
typedef struct hearth_targets hearth_targets;
typedef struct hearth_player hearth_player;   /* since 1.2 */
typedef struct hearth_queries hearth_queries; /* since 1.8 */

/* Return the HEARTH_API_VERSION of the library. */
HEARTH_API uint32_t hearth_api_version(void);

/* Return the meaning of a result, in English; never NULL. */
HEARTH_API const char* hearth_result_string(hearth_result result);

/* ---- Packs ---- */

/* Map the file and check its tables. Geometry and texels are checked later, when they are read: uploads and
 * page reads of a damaged or hostile file fail, and none of its data is drawn.
 * errors: USAGE, FILE_MISSING, FILE_MALFORMED, READ, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_pack_open(const char* path, hearth_pack** pack, char* message,
                                          size_t message_size);

/* Open a pack in memory that outlives it. `bytes` is aligned to 64; messages contain `name`. */
HEARTH_API hearth_result hearth_pack_open_memory(const void* bytes, size_t size, const char* name,
                                                 hearth_pack** pack, char* message, size_t message_size);

/* Check the whole file in one pass (1.5), as `hearth verify` does, to find damage before drawing. May run on
 * any thread, concurrently with all other calls.
 * errors: USAGE, FILE_MALFORMED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_pack_check(const hearth_pack* pack, char* message, size_t message_size);

/* Check a page, of geometry or of a texture, and decode it into `destination`, which has at least the page's size. Writes `destination`
 * from front to back and does not read it. For hearth_read_page_callback; on any thread.
 * errors: USAGE, OUT_OF_MEMORY; FILE_MALFORMED if the page contradicts its pack: `destination` is not
 * written. */
HEARTH_API hearth_result hearth_pack_read_page(const hearth_pack* pack, uint32_t page, void* destination,
                                               size_t size, char* message, size_t message_size);

/* Find a clip by its name, or else by its number (1.2). `seconds` gets its length, unless it is NULL.
 * errors: USAGE, also if there is none. */
HEARTH_API hearth_result hearth_pack_find_animation(const hearth_pack* pack, const char* name,
                                                    uint32_t* animation, double* seconds, char* message,
                                                    size_t message_size);

/* errors: IN_USE while scenes, players or queries made from it are alive. */
HEARTH_API hearth_result hearth_pack_close(hearth_pack* pack);

/* Return the message of the last failed hearth_pack_close of the pack (1.6); "" if none failed. */
HEARTH_API const char* hearth_pack_last_error(const hearth_pack* pack);

/* ---- Renderer ---- */

enum
{
    HEARTH_FEATURE_SAMPLER_ANISOTROPY = 1, /* the caller enabled samplerAnisotropy: use it */
    HEARTH_FEATURE_OVERDRAW = 2,           /* create the pipelines of HEARTH_VIEW_OVERDRAW */
    HEARTH_FEATURE_DEBUG_LABELS = 4,       /* 1.1: the caller enabled VK_EXT_debug_utils: name the passes */
    HEARTH_FEATURE_GRADING = 8,            /* 1.8: frames may have exposure_stops and a photo filter */
    /* 1.8: and bloom, automatic exposure, and targets with another output size; twice the pipelines that shade */
    HEARTH_FEATURE_FINAL_PASS = 16,
    /* 1.8: and the light methods that do not shade and light at once (HEARTH_LIGHTS_DEFERRED and on). Implies
     * HEARTH_MATERIALS_ID and HEARTH_FEATURE_FINAL_PASS, with linear colours of 8 bytes a pixel. */
    HEARTH_FEATURE_DEFERRED = 32,
    /* 1.8: the caller enabled textureCompressionASTC_HDR of VK_EXT_texture_compression_astc_hdr: use it */
    HEARTH_FEATURE_ASTC_HDR = 64,
    /* 1.8: update texels of baked light by drawn points, for devices with slow compute shaders; same texels */
    HEARTH_FEATURE_RECEIVER_POINTS = 128,
    /* 1.8: frames leave their depth to passes of the caller (hearth_targets_info.depth), which costs 5 bytes a
     * pixel on tile-based GPUs. Implies HEARTH_MATERIALS_ID. */
    HEARTH_FEATURE_DEPTH = 256
};

/* Purpose of device memory. */
enum
{
    HEARTH_MEMORY_DEVICE = 0,  /* fastest for the GPU; not mapped */
    HEARTH_MEMORY_STAGING = 1, /* mapped and coherent, written by the CPU */
    /* mapped and coherent, read by the CPU; cached if the device has such memory */
    HEARTH_MEMORY_READBACK = 2,
    /* 1.8: attachments that never leave the tile; lazily allocated if the device has such memory */
    HEARTH_MEMORY_TRANSIENT = 3,
    /* 1.8: mapped and coherent, written by the CPU and read by the GPU in place; device-local if such memory is
     * visible to the CPU */
    HEARTH_MEMORY_UPLOAD = 4
};

/* Request for the memory of one buffer or image. */
typedef struct hearth_memory_request
{
    VkMemoryRequirements needs;
    uint32_t kind;     /* HEARTH_MEMORY_* */
    uint32_t is_image; /* 1: optimally tiled; the allocator must respect bufferImageGranularity */
} hearth_memory_request;

typedef struct hearth_memory_allocation
{
    VkDeviceMemory memory;
    VkDeviceSize offset;
    void* mapped;     /* address of the allocation, for mapped kinds; until it is freed */
    void* allocation; /* private to the allocator */
} hearth_memory_allocation;

/* Device memory allocator of the caller: both functions or none. Called by calls that create and destroy
 * objects, on their thread, and for scenes with a memory_budget by those that begin and record a frame.
 * `allocate` returns memory of a type that `needs` allows, with the properties of the kind. When memory is
 * freed, nothing bound to it is in use any more. */
typedef struct hearth_memory_hooks
{
    void* user;
    VkResult (*allocate)(void* user, const hearth_memory_request* request, hearth_memory_allocation* piece);
    void (*free)(void* user, const hearth_memory_allocation* piece);
} hearth_memory_hooks;

/* Callback for warnings about degraded results that are no error, one line each: lights left out, pages that
 * cannot be read. Called on the thread of the call that finds it; must not call the library. */
typedef void (*hearth_message_callback)(void* user, const char* message);

/* How shading finds the pixels of a material (1.8); the rendered frame is the same. */
enum
{
    HEARTH_MATERIALS_DEPTH =
        0, /* numbers of materials overwrite the depth, and the depth test compares them */
    /* The shader compares numbers, and a stencil rejects early: the depth stays, which saves
     * HEARTH_OCCLUSION_LAST_FRAME a pass. */
    HEARTH_MATERIALS_ID = 1
};

/* Way through a frame (1.8); the rendered frame is the same. */
enum
{
    /* MERGED, unless public reports say that the device fails at subpasses or gains nothing by them */
    HEARTH_FRAME_AUTOMATIC = 0,
    HEARTH_FRAME_MERGED =
        1, /* render passes of two subpasses: the visibility buffer need not leave the tile */
    HEARTH_FRAME_SEPARATE =
        2,                   /* a render pass for the visibility buffer, one for shading, which samples it */
    HEARTH_FRAME_ONE_SET = 3 /* as MERGED, with one descriptor set for all that shading binds */
};

/* Material function of the game, or motion (1.8). */
typedef struct hearth_material_function
{
    const char* name;
} hearth_material_function;

/* Shader of the renderer with the game's material functions in it (1.8). */
typedef struct hearth_material_module
{
    const char* name;
    const uint32_t* words; /* SPIR-V */
    size_t word_count;
} hearth_material_module;

/* Material functions of the game (1.8), as hearth_add_material_shaders() in CMake compiles them; README.md has an
 * example. A material has the function that its extra "hearth_material" names, and the motion that "hearth_motion" names. */
typedef struct hearth_material_shaders
{
    uint32_t function_count;
    uint32_t motion_count;
    const hearth_material_function* functions;
    const hearth_material_function* motions; /* of vertices */
    size_t module_count;
    const hearth_material_module* modules;
    const char* version; /* of the shaders' sources: that of the library */
} hearth_material_shaders;

typedef struct hearth_renderer_description
{
    uint32_t struct_size;
    uint32_t api_version; /* HEARTH_API_VERSION of the header that the caller was compiled with */
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    const VkAllocationCallbacks* allocator; /* or NULL */
    VkPipelineCache pipeline_cache;         /* or VK_NULL_HANDLE */
    uint32_t features;                      /* HEARTH_FEATURE_* */
    uint32_t materials;                     /* HEARTH_MATERIALS_* (1.8) */
    /* since 1.1 */
    hearth_memory_hooks memory;      /* or NULLs: the library allocates blocks with vkAllocateMemory */
    hearth_message_callback message; /* or NULL */
    void* message_user;
    /* since 1.8 */
    uint32_t frame_way; /* HEARTH_FRAME_* */
    /* Of the images that frames show; the device can draw to it. VK_FORMAT_UNDEFINED: R8G8B8A8_SRGB.
     * - Display colours: R8G8B8A8_SRGB, B8G8R8A8_SRGB.
     * - The same as sRGB codes, for images without an SRGB format: R8G8B8A8_UNORM, B8G8R8A8_UNORM,
     *   A2B10G10R10_UNORM_PACK32, A2R10G10B10_UNORM_PACK32. 8-bit images have the bytes of the SRGB formats, but
     *   for a step of 255 where a device rounds otherwise; HEARTH_VIEW_OVERDRAW adds codes up.
     * - Radiance, for the caller's tone curve: R16G16B16A16_SFLOAT, B10G11R11_UFLOAT_PACK32. Linear, with the
     *   primaries of sRGB; behind the scene's own exposure, by which white paper in the sun has about 1, bloom,
     *   the automatic exposure and 2^exposure_stops; ahead of the tone curve and the photo filter, so
     *   filter_density is 0. Unlit colours have the radiance that Hearth's tone curve shows as them, at most
     *   32. Debug views have linear display colours.
     * Alpha is 1. */
    VkFormat color_format;
    const hearth_material_shaders* material_shaders; /* outlive the renderer; or NULL */
} hearth_renderer_description;

#define HEARTH_RENDERER_DESCRIPTION_INIT                                                                     \
    {                                                                                                        \
        sizeof(hearth_renderer_description), HEARTH_API_VERSION, NULL, VK_NULL_HANDLE, VK_NULL_HANDLE,       \
            VK_NULL_HANDLE, NULL, VK_NULL_HANDLE, 0, HEARTH_MATERIALS_DEPTH, {NULL, NULL, NULL}, NULL, NULL, \
            HEARTH_FRAME_AUTOMATIC, VK_FORMAT_UNDEFINED, NULL                                                \
    }

/* Create pipelines, which takes seconds on some devices. The objects in the description outlive the renderer.
 * errors: USAGE, DEVICE, DEVICE_FAILED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_renderer_create(const hearth_renderer_description* description,
                                                hearth_renderer** renderer, char* message,
                                                size_t message_size);

/* errors: IN_USE while scenes or targets made from it are alive. */
HEARTH_API hearth_result hearth_renderer_destroy(hearth_renderer* renderer);

/* Return the message of the last failed call on the renderer or an object made from it; "" if none failed.
 * Valid until the next call. */
HEARTH_API const char* hearth_last_error(const hearth_renderer* renderer);

/* ---- Scenes ---- */

/* Page read in flight. Pass it to hearth_read_done once. */
typedef struct hearth_page_read
{
    unsigned char internal[16];
} hearth_page_read;

/* Callback that starts to read a page, of geometry or of a texture: write its `size` decoded bytes to `destination`, as
 * hearth_pack_read_page does, then call hearth_read_done. May do so at once or later, on any thread, reads in
 * any order. Called by hearth_scene_begin_frame. */
typedef void (*hearth_read_page_callback)(void* user, uint32_t page, void* destination, size_t size,
                                          hearth_page_read read);

/* End a read; `ok` is 0 if it failed. Do not write to the destination afterwards. On any thread. */
HEARTH_API void hearth_read_done(hearth_page_read read, int ok);

/* Geometry that casts shadows (1.8). */
enum
{
    HEARTH_CASTERS_CLUSTERS = 0, /* the levels that a frame draws, or coarser ones (error_bias) */
    /* The proxy of each mesh that has one, is rigid, and has opaque lit materials alone: a shadow is off by
     * no more than the distances of hearth_proxy. */
    HEARTH_CASTERS_PROXIES = 1
};

/* Shadow maps of the lights: `splits` for a sun, one for a spot, six for a point light.
 * See runtime/gpu/README.md, "Shadows". */
typedef struct hearth_shadow_options
{
    uint32_t max_maps; /* per frame, up to 64. 0: no shadows, the other options are ignored */
    /* width and height of a map, 4 bytes per texel, 2 with 16-bit depths: a power of two from 4 * (kernel + 1)
     * to 8192 */
    uint32_t texels;
    uint32_t kernel; /* filter radius in texels, up to 3: 1 is 3 x 3 */
    uint32_t splits; /* view-dependent maps (cascades) of each sun, up to 8 */
    /* 1: draw moved casters over a copy of the resting ones, in as many more maps; or 0 */
    uint32_t moving_layers;
    float error_bias;            /* casters' error may be this many times the frame's error, 1 or more */
    float split_near, split_far; /* range of the splits in metres from the eye; 0 < near < far */
    float split_blend;           /* 0: splits of equal length, 1: each longer by the same factor */
    /* near plane of spots and point lights in metres, above 0: nearer surfaces cast no shadow */
    float spot_near;
    /* since 1.8: bits of the maps' depths, 32, or 16: half the memory where that does not show, else 32 bits
     * (hearth_shadow_counters.depth_bits) */
    uint32_t depth_bits;
    uint32_t casters; /* since 1.8: HEARTH_CASTERS_* */
} hearth_shadow_options;

#define HEARTH_SHADOW_OPTIONS_INIT                                                                           \
    {                                                                                                        \
        0, 1024, 1, 4, 1, 2, 0.1f, 100, 0.8f, 0.05f, 32, 0                                                   \
    }

/* Flags of a scene. */
/* Textures of compressed formats that the device cannot sample are decoded, which takes four times the memory
 * or more, and the time of a load; else they are an error. */
#define HEARTH_SCENE_DECODE_TEXTURES 1u
/* 1.8: keep the transforms and poses of the step before, for hearth_record_motion: their tables, 64 bytes an
 * instance and 96 bytes a joint in each frame in flight, take twice the memory. */
#define HEARTH_SCENE_MOTION 2u

typedef struct hearth_scene_options
{
    uint32_t struct_size;
    /* Largest number of clusters of a frame, 1 to 33554430, 8 bytes each; more are counted and not drawn
     * (hearth_frame_counters). */
    uint32_t max_visible_clusters;
    /* Bytes of geometry and textures on the device; `read` streams pages and mips on demand. They move between
     * both by what the frames need. 0: all is resident, at most 512 MiB of geometry. */
    uint64_t memory_budget;
    /* Needed with a budget. Before the scene is destroyed all reads must have ended or been cancelled. */
    hearth_read_page_callback read;
    void* read_user;
    /* Reads in flight, 1 to 1024; up to 128 KiB of staging memory each, outside of the budget. */
    uint32_t max_loads;
    /* Frames recorded before an earlier one has completed, 1 to 4, of any scene: everything that a frame changes
     * exists once for each. Record a frame once all but this many, less one, of those before have completed. */
    uint32_t frames_in_flight;
    hearth_shadow_options shadows;
    /* since 1.2: bytes for the vertices of deformed clusters, which are skinned once per frame; clusters that
     * do not fit are skinned on demand, with the same result */
    uint64_t skinning_bytes;
    /* since 1.8: slots of lights, up to 4096: the pack's lights, and behind them those of the game
     * (hearth_light_change); at least as many as the pack has */
    uint32_t max_lights;
    uint32_t flags; /* HEARTH_SCENE_* */
} hearth_scene_options;

#define HEARTH_SCENE_OPTIONS_INIT                                                                            \
    {                                                                                                        \
        sizeof(hearth_scene_options), 4194304, 0, NULL, NULL, 32, 3, HEARTH_SHADOW_OPTIONS_INIT, 16777216,   \
            128, 0                                                                                           \
    }

/* Record the copies of a scene. If the call fails, discard `commands`. The pack outlives the scene.
 * errors: USAGE, FILE_MALFORMED, DEVICE_FAILED, DEVICE_LIMIT, STREAMING_BUDGET, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_scene_upload(hearth_renderer* renderer, hearth_pack* pack,
                                             VkCommandBuffer commands, const hearth_scene_options* options,
                                             hearth_scene** scene);

/* Free the staging memory of the upload. Call it when the commands of the upload have completed. */
HEARTH_API hearth_result hearth_scene_release_staging(hearth_scene* scene);

/* errors: none. */
HEARTH_API hearth_result hearth_scene_destroy(hearth_scene* scene);

typedef struct hearth_scene_info
{
    uint32_t struct_size;
    uint32_t instance_count;
    uint32_t dropped_lights;   /* lights beyond the capacity, not drawn */
    uint32_t decoded_textures; /* textures of formats that the device lacks */
    /* Bounds of the instances as loaded; box_min is above box_max if there is nothing to draw. */
    float box_min[3];
    float box_max[3];
    uint64_t allocated_bytes; /* device memory, including staging memory of streaming */
} hearth_scene_info;

#define HEARTH_SCENE_INFO_INIT                                                                               \
    {                                                                                                        \
        sizeof(hearth_scene_info), 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0                                          \
    }

HEARTH_API hearth_result hearth_scene_get_info(const hearth_scene* scene, hearth_scene_info* info);

/* Create the pipelines of a light method (HEARTH_LIGHTS_*, 1.8) before a frame of the scene that uses it.
 * errors: USAGE, DEVICE_FAILED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_scene_prepare_lights(hearth_scene* scene, uint32_t method);

/* Create what hearth_record_picks needs (1.8), once for a scene.
 * errors: USAGE, DEVICE_FAILED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_scene_prepare_picks(hearth_scene* scene);

/* ---- Streaming ---- */

/* Begin a frame of a scene with a budget: take the pages that were read, start reads. A record call must
 * follow.
 * serial            of the frame: greater than the serial of the last frame, at least 1
 * completed_serial  all frames up to this one have completed; below serial, never decreases */
HEARTH_API hearth_result hearth_scene_begin_frame(hearth_scene* scene, uint64_t serial,
                                                  uint64_t completed_serial);

typedef struct hearth_stream_counters
{
    uint32_t struct_size;
    float error_scale;       /* factor on error thresholds: above 1 if the needed pages exceed the budget */
    uint64_t budget_bytes;   /* share of geometry now, rounded down to the bytes that pages can use */
    uint64_t bytes_in_use;   /* of the budget */
    uint64_t bytes_resident; /* of decoded pages */
    uint64_t bytes_streamed; /* so far */
    uint64_t settled_serial; /* last frame that drew all that it needed and could get; 0: none yet */
    uint32_t pages_resident;
    uint32_t reads_in_flight; /* started, end not yet seen by a frame */
    uint32_t failures;        /* so far */
    uint32_t failed_page_count;
    const uint32_t* failed_pages; /* failures that the last begin_frame saw, each once; until the next one */
    /* Textures, 0 if none are streamed: their share of the budget now, and what they take of it. */
    uint64_t texture_budget_bytes;
    uint64_t texture_bytes_in_use;
    uint64_t texture_bytes_on_device; /* at most texture_bytes_in_use */
    uint64_t texture_bytes_streamed;  /* so far */
    uint32_t texture_failures;        /* mips that could not be read, so far */
    float texture_error_scale; /* pixels a texel that are asked for: above 1 if the share is too small */
} hearth_stream_counters;

#define HEARTH_STREAM_COUNTERS_INIT                                                                          \
    {                                                                                                        \
        sizeof(hearth_stream_counters), 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, NULL, 0, 0, 0, 0, 0, 1                 \
    }

/* errors: USAGE, also if the scene has no budget. */
HEARTH_API hearth_result hearth_scene_get_stream_counters(const hearth_scene* scene,
                                                          hearth_stream_counters* counters);

/* Allow failed pages to be read again. errors: USAGE, also if the scene has no budget. */
HEARTH_API hearth_result hearth_scene_retry_failed(hearth_scene* scene);

/* ---- Shadows ---- */

/* Shadow statistics of the last recorded frame. */
typedef struct hearth_shadow_counters
{
    uint32_t struct_size;
    uint32_t maps;              /* in use */
    uint32_t drawn_maps;        /* drawn by the frame; the others were cached */
    uint32_t moved_maps;        /* maps in which the frame drew moving casters */
    uint32_t dropped_maps;      /* beyond max_maps */
    uint32_t unshadowed_lights; /* lights that are on, without a map */
    uint32_t depth_bits;      /* since 1.8: of the maps; 32 if a step of 16 bits would show in any of them */
    uint32_t shadowed_lights; /* since 1.8: lights with maps */
    uint32_t unseen_maps;     /* since 1.8: faces of point lights that nothing in view is in, without a map */
} hearth_shadow_counters;

#define HEARTH_SHADOW_COUNTERS_INIT                                                                          \
    {                                                                                                        \
        sizeof(hearth_shadow_counters), 0, 0, 0, 0, 0, 0, 0, 0                                               \
    }

/* errors: USAGE, also if the scene has no shadows. */
HEARTH_API hearth_result hearth_scene_get_shadow_counters(const hearth_scene* scene,
                                                          hearth_shadow_counters* counters);

/* ---- Targets: the images of a frame. Each camera has its own, since they hold its temporal history. ----
 *
 * Targets belong to the first scene that is recorded with them, until it is destroyed: a frame draws one
 * scene, and a second one would overwrite the image. Recording another scene with them is an error.
 * hearth_record_prefetch, which draws nothing, accepts the targets of any scene. */

/* Occlusion culling of frames with HEARTH_CULL_OCCLUSION (1.8). */
enum
{
    HEARTH_OCCLUSION_TWO_PHASE = 0, /* lossless */
    /* Against an earlier frame's depth alone, in one render pass: objects that come into view may be missing
     * for a frame, or for two where no part, tiles or gathered light lie between visibility and shading. */
    HEARTH_OCCLUSION_LAST_FRAME = 1,
    HEARTH_OCCLUSION_OFF = 2 /* as without HEARTH_CULL_OCCLUSION */
};

enum
{
    HEARTH_TARGETS_KEEP_VISIBILITY = 1, /* the visibility buffer can be copied after a frame */
    /* frames may be recorded in parts, with HEARTH_SHADE_TILES, or with a light method that splits them, also
     * where the scene does not need it */
    HEARTH_TARGETS_SPLIT = 2,
    HEARTH_TARGETS_COUNT_MISSING = 4, /* hearth_record_missing may follow a frame: takes a second pyramid */
    /* frames may have bloom or automatic exposure; with HEARTH_FEATURE_FINAL_PASS */
    HEARTH_TARGETS_BLOOM = 8,
    /* frames may use a light method that stores surfaces; with HEARTH_FEATURE_DEFERRED */
    HEARTH_TARGETS_DEFERRED = 16,
    /* the same, but only HEARTH_LIGHTS_TILE_DEFERRED without bloom, automatic exposure and another output
     * size: surfaces need no memory on tile-based GPUs */
    HEARTH_TARGETS_TILE_DEFERRED = 32,
    /* frames may use these light methods; with HEARTH_FEATURE_DEFERRED */
    HEARTH_TARGETS_STACK = 64,
    HEARTH_TARGETS_PREPASS = 128,
    HEARTH_TARGETS_CLASSIC_PREPASS = 256,
    HEARTH_TARGETS_ENCODED_PREPASS = 512,
    HEARTH_TARGETS_MOTION = 1024, /* hearth_record_motion may follow a frame; implies KEEP_VISIBILITY */
    /* hearth_record_anti_aliasing may follow a frame; implies MOTION. Without images of the caller, in
     * R8G8B8A8_SRGB. */
    HEARTH_TARGETS_ANTI_ALIASING = 2048
};

/* State of an image, as a barrier names it. */
typedef struct hearth_image_state
{
    VkImageLayout layout;
    VkPipelineStageFlags stages;
    VkAccessFlags access;
} hearth_image_state;

typedef struct hearth_image
{
    VkImage image; /* usage COLOR_ATTACHMENT and TRANSFER_SRC; one mip, one layer */
    VkFormat format;
    hearth_image_state before; /* a frame waits for such uses of the image; the content is lost */
    hearth_image_state after;  /* state after a frame, visible to these accesses */
} hearth_image;

/* What frames with the targets may ask for (1.8): images that never leave a tile-based GPU's tile need no
 * memory, and what no frame uses is not created. */
typedef struct hearth_targets_description
{
    uint32_t struct_size;
    uint32_t width, height;    /* pixels that are drawn, 1 to the limit of the device */
    uint32_t occlusion;        /* HEARTH_OCCLUSION_*: the first of them that a frame may have */
    uint32_t flags;            /* HEARTH_TARGETS_* */
    uint32_t color_count;      /* of colors */
    const hearth_scene* scene; /* that they will show, which saves what it does not need; or NULL: any */
    /* pixels of the image, to which a final pass enlarges or reduces what is drawn; 0: width and height */
    uint32_t output_width, output_height;
    /* Images of the caller that frames show, each frame one of them (hearth_frame.color_image): of a swapchain,
     * or imported. All have the renderer's color_format, one `before` and one `after`, usage COLOR_ATTACHMENT,
     * the output's size, one mip and one layer, and outlive the targets. `before` has the uses that a frame
     * waits for, with any layout: for a swapchain the stage whose wait for its semaphore is submitted,
     * COLOR_ATTACHMENT_OUTPUT, and no access. The render pass that ends a frame leaves the image in the state
     * `after`. NULL, with color_count 0: the targets have an image. */
    const hearth_image* colors;
} hearth_targets_description;

#define HEARTH_TARGETS_DESCRIPTION_INIT                                                                      \
    {                                                                                                        \
        sizeof(hearth_targets_description), 0, 0, HEARTH_OCCLUSION_TWO_PHASE, 0, 0, NULL, 0, 0, NULL         \
    }

/* errors: USAGE, DEVICE_LIMIT, DEVICE_FAILED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_targets_create(hearth_renderer* renderer,
                                               const hearth_targets_description* description,
                                               hearth_targets** targets);

HEARTH_API hearth_result hearth_targets_destroy(hearth_targets* targets);

typedef struct hearth_targets_info
{
    uint32_t struct_size;
    uint32_t width, height; /* pixels that are drawn */
    uint32_t reserved;      /* 0 */
    hearth_image color;     /* of the renderer's color_format and the output's size; the first of `colors` */
    /* R32_UINT: slot of the visible list << 7 | triangle, or 0xFFFFFFFF. With HEARTH_TARGETS_KEEP_VISIBILITY;
     * else `image` is VK_NULL_HANDLE. */
    hearth_image visibility;
    uint64_t allocated_bytes; /* without transient_bytes */
    uint64_t
        transient_bytes; /* of attachments on the tile only, which the device allocates lazily, if ever */
    /* since 1.8: D32_SFLOAT_S8_UINT, for draws of the game behind the frame: z_near over the distance along
     * the camera's axis, or as an orthographic camera has it, 0 where nothing is; the stencil is Hearth's. Usage DEPTH_STENCIL_ATTACHMENT, SAMPLED
     * and TRANSFER_SRC. Give it back in the state `before`: the next frame may cull against it. With
     * HEARTH_FEATURE_DEPTH; else `image` is VK_NULL_HANDLE. */
    hearth_image depth;
    /* since 1.8: R16G16_SFLOAT, of hearth_record_motion. Usage COLOR_ATTACHMENT, SAMPLED and TRANSFER_SRC.
     * With HEARTH_TARGETS_MOTION; else `image` is VK_NULL_HANDLE. */
    hearth_image motion;
    /* since 1.8: R8G8B8A8_SRGB, the frame that hearth_record_anti_aliasing has filtered. Usage
     * COLOR_ATTACHMENT and TRANSFER_SRC. With HEARTH_TARGETS_ANTI_ALIASING; else `image` is VK_NULL_HANDLE. */
    hearth_image filtered;
} hearth_targets_info;

#define HEARTH_IMAGE_INIT                                                                                    \
    {                                                                                                        \
        VK_NULL_HANDLE, VK_FORMAT_UNDEFINED, {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0},                              \
        {                                                                                                    \
            VK_IMAGE_LAYOUT_UNDEFINED, 0, 0                                                                  \
        }                                                                                                    \
    }
#define HEARTH_TARGETS_INFO_INIT                                                                             \
    {                                                                                                        \
        sizeof(hearth_targets_info), 0, 0, 0, HEARTH_IMAGE_INIT, HEARTH_IMAGE_INIT, 0, 0, HEARTH_IMAGE_INIT, \
            HEARTH_IMAGE_INIT, HEARTH_IMAGE_INIT                                                             \
    }

HEARTH_API hearth_result hearth_targets_get_info(const hearth_targets* targets, hearth_targets_info* info);

/* ---- Frames ---- */

/* Culling tests; the rendered frame is the same, but for HEARTH_OCCLUSION_LAST_FRAME. */
enum
{
    HEARTH_CULL_INSTANCES = 1,
    HEARTH_CULL_FRUSTUM = 2,
    HEARTH_CULL_CONE = 4,
    HEARTH_CULL_OCCLUSION = 8,
    HEARTH_CULL_EVERYTHING = 15
};

/* Debug views. */
enum
{
    HEARTH_VIEW_FINAL = 0,
    HEARTH_VIEW_CLUSTERS = 1,
    HEARTH_VIEW_LOD = 2,
    HEARTH_VIEW_TRIANGLES = 3,
    HEARTH_VIEW_NORMALS = 4,
    HEARTH_VIEW_DEPTH = 5,
    HEARTH_VIEW_MATERIALS = 6,
    HEARTH_VIEW_ERROR = 7,
    HEARTH_VIEW_CONES = 8,
    HEARTH_VIEW_OVERDRAW = 9,     /* needs HEARTH_FEATURE_OVERDRAW */
    HEARTH_VIEW_SHADOW_MAPS = 10, /* map that each pixel reads; needs a scene with shadows */
    HEARTH_VIEW_BONES = 11,       /* 1.2: main joints of characters */
    /* 1.3: for packs with sky visibility; dark red: the mesh has none */
    HEARTH_VIEW_AMBIENT_OCCLUSION = 12,
    HEARTH_VIEW_BENT_NORMAL = 13,        /* axis of the visibility cone */
    HEARTH_VIEW_APERTURE = 14,           /* half-angle of the cone, white: 90 degrees */
    HEARTH_VIEW_SPECULAR_OCCLUSION = 15, /* for the direction to the eye */
    /* 1.4: need a scene whose pack has bricks */
    HEARTH_VIEW_BRICKS = 16,         /* albedo of the first voxel that a pixel's ray hits */
    HEARTH_VIEW_BRICK_LIGHTING = 17, /* radiance of that voxel */
    HEARTH_VIEW_GI = 18,             /* indirect light (GI) alone, on white surfaces */
    /* 1.8 */
    HEARTH_VIEW_LIGHT_COUNT = 19, /* lights that each pixel evaluates */
    HEARTH_VIEW_LIGHT_CELLS = 20, /* cells of the light grid */
    HEARTH_VIEW_RECEIVERS = 21    /* baked light in its texels, on white surfaces; violet: none */
};

/* Ambient occlusion of the sky, for packs with sky visibility (1.3). */
enum
{
    HEARTH_AMBIENT_OCCLUSION_EXACT = 0,
    HEARTH_AMBIENT_OCCLUSION_SMOOTHSTEP = 1,
    HEARTH_AMBIENT_OCCLUSION_QUADRATIC = 2,
    HEARTH_AMBIENT_OCCLUSION_OFF = 3
};

/* Specular occlusion of the sky (1.3). */
enum
{
    HEARTH_SPECULAR_OCCLUSION_FIT = 0,
    HEARTH_SPECULAR_OCCLUSION_TABLE = 1, /* of the pack; FIT if it has none */
    HEARTH_SPECULAR_OCCLUSION_OFF = 2
};

/* Area in which each material is shaded; the rendered frame is the same. */
enum
{
    HEARTH_SHADE_AUTOMATIC = 0,
    HEARTH_SHADE_WHOLE_FRAME = 1,
    HEARTH_SHADE_TILES = 2
};

/* Timestamps: one at the beginning of a frame and one after each pass, never within a render pass. Where shading
 * follows the visibility buffer in one render pass, the pass counts as shading. */
enum
{
    HEARTH_TIMESTAMP_BEGIN = 0,
    /* includes the update of brick faces (GI); no time without shadow maps to draw and bricks */
    HEARTH_TIMESTAMP_SHADOWS = 1,
    HEARTH_TIMESTAMP_CULL = 2,
    HEARTH_TIMESTAMP_EARLY_VISIBILITY = 3, /* this and the two after it: no time without occlusion culling */
    HEARTH_TIMESTAMP_PYRAMID = 4,
    HEARTH_TIMESTAMP_LATE_CULL = 5,
    HEARTH_TIMESTAMP_VISIBILITY = 6,
    HEARTH_TIMESTAMP_MATERIAL_TILES = 7, /* includes gathering (GI) */
    HEARTH_TIMESTAMP_SHADING = 8,
    HEARTH_TIMESTAMP_COUNT = 9
};

/* Perspective camera: the far plane is infinite, depth = z_near / distance along the view. Or an orthographic
 * one, if y_fov_rad is 0 (1.8): hearth_frame.half_height. */
typedef struct hearth_camera
{
    float position[3];
    float target[3]; /* any point on the view axis */
    float up[3];
    float y_fov_rad; /* full vertical angle, above 0 and below pi; or 0 */
    float z_near;    /* metres, above 0 */
} hearth_camera;

/* Knot of the factor on errors by distance: linear between knots, constant beyond the first and the last. */
typedef struct hearth_lod_knot
{
    float distance; /* metres from the eye, 0 or more, greater than that of the knot before */
    /* Above 1 is finer. At most 8 times the factor of the knot before, and at least an eighth of it; grows no
     * faster than the distance. */
    float factor;
} hearth_lod_knot;

/* New transform of an instance, from this frame on. */
typedef struct hearth_move
{
    uint32_t instance;
    float world_from_object[3][4]; /* rows; finite */
} hearth_move;

/* Affine transform in double precision, rows (1.2). */
typedef struct hearth_transform
{
    double m[3][4];
} hearth_transform;

/* New pose of an instance whose mesh has joints or morph targets, from this frame on (1.2). */
typedef struct hearth_pose
{
    uint32_t instance;
    uint32_t joint_count;                    /* of its skin; 1 without a skin */
    const hearth_transform* world_from_bind; /* per joint; without a skin the transform of the node; finite */
    const float* morph_weights;              /* finite */
    uint32_t morph_weight_count;             /* the morph targets of its mesh */
    /* 1: not a pose of the pack's clips, nor a blend of two (ragdoll, inverse kinematics, weights outside of
     * 0 to 1): culled by joint positions, which culls less; or 0 */
    uint32_t is_free;
} hearth_pose;

#define HEARTH_ALL_LIGHTS 0xFFFFFFFFu

/* Sphere of finer shadows with a map of its own, beside the spheres of the pack. */
typedef struct hearth_shadow_sphere
{
    float center[3]; /* world */
    float radius;    /* metres, above 0 */
    uint32_t light;  /* index in the pack, or HEARTH_ALL_LIGHTS */
    /* Width and height of its map, rounded down to a power of two; 0: hearth_shadow_options.texels, the
     * maximum. */
    uint32_t texels;
} hearth_shadow_sphere;

/* Type of a light (1.8). */
enum
{
    HEARTH_LIGHT_SAME = 0, /* as the slot has it */
    HEARTH_LIGHT_SUN = 1,
    HEARTH_LIGHT_POINT = 2,
    HEARTH_LIGHT_SPOT = 3
};

/* New state of a slot's light, from this frame on (1.4): a light of the pack, or one of the game (1.8). All
 * finite. Changes of lights that the scene left out (dropped_lights) have no effect. */
typedef struct hearth_light_change
{
    uint32_t light; /* slot: index in the pack, or behind, below hearth_scene_options.max_lights */
    float world_from_light[3][4]; /* rows; the light shines along -z */
    float color[3];               /* linear */
    float intensity;              /* candela; lux of a sun; 0: off, which also frees a slot */
    float range;                  /* metres; 0: unlimited: every pixel evaluates such a light */
    float inner_cone_rad;         /* of a spot */
    float outer_cone_rad;
    uint32_t type; /* since 1.8: HEARTH_LIGHT_* */
    /* since 1.8: intensity without flicker, by which lights are ranked for shadow maps; 0: as intensity */
    float steady_intensity;
} hearth_light_change;

/* Lights that a pixel evaluates (1.8). The images are the same. */
enum
{
    HEARTH_LIGHTS_PRACTICAL = 0, /* those that reach its cell of a grid over the view */
    HEARTH_LIGHTS_ALL = 1,
    /* the next two split a frame behind its visibility buffer: targets with HEARTH_TARGETS_SPLIT */
    HEARTH_LIGHTS_TILED_FORWARD = 2,     /* those that reach its tile, between the depths that it shows */
    HEARTH_LIGHTS_CLUSTERED_FORWARD = 3, /* as PRACTICAL; only cells that a pixel shows have lists */
    HEARTH_LIGHTS_FORWARD = 4,           /* those that reach the box of its cluster */
    /* Those that store surfaces, by a renderer with HEARTH_FEATURE_DEFERRED: what they round differs by 2 of
     * 255 at most. TILED and CLUSTERED split a frame as above. */
    HEARTH_LIGHTS_DEFERRED = 5,           /* light by light, in the pixels of its volume */
    HEARTH_LIGHTS_TILED_DEFERRED = 6,     /* lists as TILED_FORWARD */
    HEARTH_LIGHTS_CLUSTERED_DEFERRED = 7, /* lists as CLUSTERED_FORWARD */
    HEARTH_LIGHTS_TILE_DEFERRED = 8,      /* as DEFERRED, in one render pass */
    /* The next four act between visibility and shading, in one render pass, by a renderer with
     * HEARTH_FEATURE_DEFERRED. */
    HEARTH_LIGHTS_STACK = 9,    /* bits of a pixel name its lights; the image has the bytes of PRACTICAL */
    HEARTH_LIGHTS_PREPASS = 10, /* lights are summed, and weighed by materials: 2 of 255 at most */
    /* the same with less bytes: specular light has the hue of diffuse light, and the image differs */
    HEARTH_LIGHTS_CLASSIC_PREPASS = 11,
    /* the same, and lights read depths of 16 bits beside the normals, and no others */
    HEARTH_LIGHTS_ENCODED_PREPASS = 12
};

/* Processor that lists the lights of cells, of PRACTICAL and ALL (1.8). The lists are the same. */
enum
{
    HEARTH_LIGHT_LISTS_GPU = 0,
    HEARTH_LIGHT_LISTS_CPU = 1
};

/* Factor on the emission of the brick faces inside a box of the world, relative to the pack (1.4). Bricks with
 * receivers take the weights of instances that emit in its place (HEARTH_LAMP_EMISSION). */
typedef struct hearth_emission_scale
{
    float box_min[3];
    float box_max[3];
    float factor; /* 0 or more */
} hearth_emission_scale;

/* Lamps that have weights (1.8). */
enum
{
    HEARTH_LAMP_LIGHT = 1,   /* slot of a light, of the pack or the game */
    HEARTH_LAMP_EMISSION = 2 /* instance that emits, of a pack with receivers */
};

/* Factor on all light of a lamp, live and baked, from this frame on until it is set anew (1.8). Names of lights
 * and instances: hearth_pack_get_name. */
typedef struct hearth_lamp_weight
{
    uint32_t lamp;   /* HEARTH_LAMP_* */
    uint32_t index;  /* of the light's slot, or of the instance */
    float weight[3]; /* red, green, blue: finite, 0 or more */
} hearth_lamp_weight;

/* Sun and clear sky (1.8), in place of the scene's sky and its first directional light. The sky's light that was baked
 * into receivers follows in brightness and colour, not in direction; that of local probes stays. */
typedef struct hearth_daylight
{
    float elevation_deg; /* of the sun above the horizon, 0 to 90 */
    float azimuth_deg;   /* of the sun, finite: 0 towards -z, 90 towards +x */
    float turbidity;     /* haze, 2.5 (clear) to 8; or 0: sky and sun as the pack has them */
    uint32_t reserved;   /* 0 */
} hearth_daylight;

enum
{
    HEARTH_BLOOM_MIX = 0, /* the spread light replaces a share of the image, whose mean it keeps */
    HEARTH_BLOOM_ADD = 1
};

typedef struct hearth_frame
{
    uint32_t struct_size;
    uint32_t cull_flags; /* HEARTH_CULL_* */
    hearth_camera camera;
    float error_pixels;               /* largest allowed projected error; 0: the source triangles */
    const hearth_lod_knot* lod_knots; /* read while recording */
    uint32_t lod_knot_count;          /* 0 to 8; 0: no distance curve */
    uint32_t move_count;
    const hearth_move* moves;     /* read while recording; an instance at most once */
    uint32_t debug_view;          /* HEARTH_SHOW_* */
    float depth_scale;            /* metres that HEARTH_VIEW_DEPTH shows as middle grey, above 0 */
    uint32_t shaded_area;         /* HEARTH_SHADE_* */
    uint32_t shadow_sphere_count; /* for scenes with shadows; else ignored */
    const hearth_shadow_sphere* shadow_spheres; /* all of this frame; read while recording */
    VkQueryPool timestamps; /* of HEARTH_TIMESTAMP_COUNT timestamps, reset by the frame; or VK_NULL_HANDLE */
    /* since 1.2 */
    const hearth_pose* poses; /* read while recording; an instance at most once */
    uint32_t pose_count;
    /* since 1.3 */
    uint32_t ambient_occlusion;  /* HEARTH_AMBIENT_OCCLUSION_* */
    uint32_t specular_occlusion; /* HEARTH_SPECULAR_OCCLUSION_* */
    /* since 1.4 */
    uint32_t constant_sky; /* 1: constant sky light without GI, also in scenes with bricks; or 0 */
    const hearth_light_change* lights;      /* read while recording */
    const hearth_emission_scale* emissions; /* all of this frame; read while recording */
    uint32_t light_count;
    uint32_t emission_count; /* up to 8 */
    /* since 1.8 */
    uint32_t occlusion; /* HEARTH_OCCLUSION_*, with HEARTH_CULL_OCCLUSION */
    /* behind the lighting of HEARTH_VIEW_FINAL; neutral by default */
    float exposure_stops;         /* 1: twice as bright; behind the automatic exposure */
    uint32_t automatic_exposure;  /* 1: follows the light of the frames before with the targets; or 0 */
    float exposure_key;           /* luminance that the mean of a frame gets (of logarithms), above 0 */
    float exposure_time_constant; /* seconds in which it goes 63 % of the way; 0: at once */
    float exposure_time_step;     /* seconds since the last frame */
    float filter_color[3];        /* of a photo filter, linear, 0 to 1 */
    float filter_density;         /* 0: no filter, to 1 */
    float bloom_strength;         /* 0: no bloom, to 1: share of the light that spreads */
    uint32_t bloom_mode;          /* HEARTH_BLOOM_* */
    uint32_t
        light_method; /* HEARTH_LIGHTS_*; all but the first are prepared before: hearth_scene_prepare_lights */
    uint32_t light_lists;                   /* HEARTH_LIGHT_LISTS_* */
    const hearth_lamp_weight* lamp_weights; /* read while recording */
    uint32_t lamp_weight_count;
    uint32_t color_image; /* number of the targets' `colors` that the frame shows; 0 if they have none */
    /* from this frame on, until it is set anew; before `lights`. NULL: no change. An error where the sky is an image */
    const hearth_daylight* daylight;
    /* Off-centre images (eyes of a headset, parts of a large image, jitter): place of the camera's axis in the
     * image, from its middle, in halves of its width to the right and of its height upwards; -1024 to 1024.
     * Moved by p pixels: 2 * p / width. */
    float shift[2];
    /* Of orthographic cameras, ignored for others: half the height of the image, metres, above 0, and the
     * distance along the view beyond which nothing is drawn, above z_near. depth = (z_far - distance) /
     * (z_far - z_near), in floats: steps of 6e-8 of the range at z_near. Errors count equally at all distances:
     * such frames have no lod_knots. All faces of point lights count as seen (unseen_maps). */
    float half_height, z_far;
    float material_inputs[4]; /* for the material functions of the game: a time, a wind; finite */
} hearth_frame;

#define HEARTH_FRAME_INIT                                                                                    \
    {                                                                                                        \
        sizeof(hearth_frame), HEARTH_CULL_EVERYTHING, {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.8f, 0.01f}, 1,    \
            NULL, 0, 0, NULL, HEARTH_VIEW_FINAL, 1, HEARTH_SHADE_AUTOMATIC, 0, NULL, VK_NULL_HANDLE, NULL,   \
            0, HEARTH_AMBIENT_OCCLUSION_EXACT, HEARTH_SPECULAR_OCCLUSION_FIT, 0, NULL, NULL, 0, 0, 0, 0, 0,  \
            0.18f, 1, 0, {1, 1, 1}, 0, 0, HEARTH_BLOOM_MIX, HEARTH_LIGHTS_PRACTICAL, HEARTH_LIGHT_LISTS_GPU, \
            NULL, 0, 0, NULL, {0, 0}, 0, 0, {0, 0, 0, 0}                                                     \
    }

/* ---- Tables of a pack (1.6), on any thread ----
 *
 * Moves, poses, clips and light changes refer to records by index. */

enum
{
    HEARTH_TABLE_NODES = 0,
    HEARTH_TABLE_INSTANCES = 1,
    HEARTH_TABLE_MESHES = 2,
    HEARTH_TABLE_MATERIALS = 3,
    HEARTH_TABLE_IMAGES = 4,
    HEARTH_TABLE_CAMERAS = 5,
    HEARTH_TABLE_LIGHTS = 6,
    HEARTH_TABLE_SKINS = 7,
    HEARTH_TABLE_ANIMATIONS = 8,
    HEARTH_TABLE_ASSETS = 9,   /* 1.7: the sources of the pack, by file name */
    HEARTH_TABLE_PROXIES = 10, /* 1.8: they have the names of their meshes */
    HEARTH_TABLE_JOINTS = 11   /* 1.8: of all skins, skin by skin; they have the names of their nodes */
};

/* Count the records of a table (HEARTH_TABLE_*). errors: USAGE. */
HEARTH_API hearth_result hearth_pack_get_count(const hearth_pack* pack, uint32_t table, uint32_t* count,
                                               char* message, size_t message_size);

/* Name in UTF-8, valid while the pack is open. Not zero-terminated: print it with "%.*s", length, text. */
typedef struct hearth_name
{
    const char* text; /* not NULL */
    size_t length;    /* bytes; 0: no name in the source */
} hearth_name;

/* Read the name of a record; an instance has the name of its node. Several records may have the same name.
 * errors: USAGE, also if there is no such record. */
HEARTH_API hearth_result hearth_pack_get_name(const hearth_pack* pack, uint32_t table, uint32_t index,
                                              hearth_name* name, char* message, size_t message_size);

/* Find a record by its name (1.8): the first whose index is `first` or more. To go on, pass the index that
 * was found, plus 1. Time: linear in the table.
 * name   UTF-8, compared byte by byte; "": records without a name
 * errors: USAGE, also if there is none. */
HEARTH_API hearth_result hearth_pack_find_record(const hearth_pack* pack, uint32_t table, const char* name,
                                                 uint32_t first, uint32_t* index, char* message,
                                                 size_t message_size);

/* ---- Extras (1.7), on any thread ----
 *
 * Custom properties that artists give to objects: "extras" of glTF. Hearth hands them on unread. */

/* Kind of object. The last three are of a source as a whole: their index is that of HEARTH_TABLE_ASSETS. */
enum
{
    HEARTH_EXTRAS_NODE = 0,
    HEARTH_EXTRAS_MESH = 1,
    HEARTH_EXTRAS_MATERIAL = 2,
    HEARTH_EXTRAS_CAMERA = 3,
    HEARTH_EXTRAS_LIGHT = 4,
    HEARTH_EXTRAS_SKIN = 5,
    HEARTH_EXTRAS_ANIMATION = 6,
    HEARTH_EXTRAS_ASSET = 7, /* glTF's object "asset", with the author and the licence */
    HEARTH_EXTRAS_SCENE = 8, /* the source's scene that is drawn */
    HEARTH_EXTRAS_FILE = 9   /* the source's whole document */
};

/* JSON text in UTF-8 without white space between tokens, otherwise as the source has it: digits of numbers,
 * escapes of strings, the order of members. Not zero-terminated. Valid while the pack is open. Opening a pack
 * does not parse it: a game does, with a parser that bears broken text. */
typedef struct hearth_extras
{
    const char* json; /* NULL: the object has no extras */
    size_t length;    /* bytes, at most 16 MiB; 0: none */
} hearth_extras;

/* Read the extras of an object. errors: USAGE, also if there is no such object. */
HEARTH_API hearth_result hearth_pack_get_extras(const hearth_pack* pack, uint32_t owner, uint32_t index,
                                                hearth_extras* extras, char* message, size_t message_size);

/* Find an object by a custom property (1.8): the first of the kind, with an index of `first` or more, whose
 * extras are an object with the member `name`. To go on, pass the index that was found, plus 1. Skips broken
 * text. Time: linear in the extras of the pack.
 * name   compared byte by byte with the text between the quotes, whose escapes stay as they are
 * index  of the object
 * value  JSON text of the member; or NULL
 * errors: USAGE, also if there is none. */
HEARTH_API hearth_result hearth_pack_find_extra(const hearth_pack* pack, uint32_t owner, const char* name,
                                                uint32_t first, uint32_t* index, hearth_extras* value,
                                                char* message, size_t message_size);

/* Node of the source's scene (1.8). */
typedef struct hearth_pack_node
{
    uint32_t struct_size;
    uint32_t parent;                   /* UINT32_MAX: none */
    uint32_t mesh;                     /* UINT32_MAX: none */
    uint32_t skin;                     /* UINT32_MAX: none */
    hearth_transform parent_from_node; /* at rest */
    hearth_transform world_from_node;  /* at rest */
} hearth_pack_node;

#define HEARTH_PACK_NODE_INIT                                                                                \
    {                                                                                                        \
        sizeof(hearth_pack_node), 0, 0, 0, {{{0}}},                                                          \
        {                                                                                                    \
            {                                                                                                \
                {                                                                                            \
                    0                                                                                        \
                }                                                                                            \
            }                                                                                                \
        }                                                                                                    \
    }

/* errors: USAGE, also if there is no such node. */
HEARTH_API hearth_result hearth_pack_get_node(const hearth_pack* pack, uint32_t index, hearth_pack_node* node,
                                              char* message, size_t message_size);

/* Mesh (1.8). A pose of its instances has the joints of `skin`, or one transform without a skin. */
typedef struct hearth_pack_mesh
{
    uint32_t struct_size;
    uint32_t triangle_count; /* of the source; without area: left out */
    uint32_t level_count;    /* 0: nothing to draw */
    uint32_t skin;           /* UINT32_MAX: none */
    uint32_t morph_weight_count;
    uint32_t is_deformed; /* 1: its instances have poses (hearth_pose); 0: they have moves (hearth_move) */
    float box_min[3];     /* object space, bind pose; box_min is above box_max if there is nothing to draw */
    float box_max[3];
} hearth_pack_mesh;

#define HEARTH_PACK_MESH_INIT                                                                                \
    {                                                                                                        \
        sizeof(hearth_pack_mesh), 0, 0, 0, 0, 0, {0, 0, 0},                                                  \
        {                                                                                                    \
            0, 0, 0                                                                                          \
        }                                                                                                    \
    }

/* errors: USAGE, also if there is no such mesh. */
HEARTH_API hearth_result hearth_pack_get_mesh(const hearth_pack* pack, uint32_t index, hearth_pack_mesh* mesh,
                                              char* message, size_t message_size);

/* Skin (1.8). Poses have its joints in this order: joint i of a pose is record first_joint + i of
 * HEARTH_TABLE_JOINTS. */
typedef struct hearth_pack_skin
{
    uint32_t struct_size;
    uint32_t first_joint;
    uint32_t joint_count;
    uint32_t root; /* node above all joints, as the source names it; UINT32_MAX: none */
} hearth_pack_skin;

#define HEARTH_PACK_SKIN_INIT                                                                                \
    {                                                                                                        \
        sizeof(hearth_pack_skin), 0, 0, 0                                                                    \
    }

/* errors: USAGE, also if there is no such skin. */
HEARTH_API hearth_result hearth_pack_get_skin(const hearth_pack* pack, uint32_t index, hearth_pack_skin* skin,
                                              char* message, size_t message_size);

/* Joint of a skin (1.8). A pose has the product of the joint's transform to the world and joint_from_bind. */
typedef struct hearth_pack_joint
{
    uint32_t struct_size;
    uint32_t node;
    /* joint of the same skin on the way to the root of the nodes, the nearest one, as a record of
     * HEARTH_TABLE_JOINTS; UINT32_MAX: none */
    uint32_t parent;
    uint32_t reserved; /* 0 */
    hearth_transform joint_from_bind;
} hearth_pack_joint;

#define HEARTH_PACK_JOINT_INIT                                                                               \
    {                                                                                                        \
        sizeof(hearth_pack_joint), 0, 0, 0,                                                                  \
        {                                                                                                    \
            {                                                                                                \
                {                                                                                            \
                    0                                                                                        \
                }                                                                                            \
            }                                                                                                \
        }                                                                                                    \
    }

/* errors: USAGE, also if there is no such joint. */
HEARTH_API hearth_result hearth_pack_get_joint(const hearth_pack* pack, uint32_t index,
                                               hearth_pack_joint* joint, char* message, size_t message_size);

/* Read a light (1.8) as the pack has it, without its flicker, ready to be changed for hearth_frame.lights.
 * node  that it shines from; or NULL
 * errors: USAGE, also if there is no such light. */
HEARTH_API hearth_result hearth_pack_get_light(const hearth_pack* pack, uint32_t index,
                                               hearth_light_change* light, uint32_t* node, char* message,
                                               size_t message_size);

/* Placed mesh. */
typedef struct hearth_pack_instance
{
    uint32_t struct_size;
    uint32_t mesh;
    uint32_t node;                 /* source node */
    uint32_t reserved;             /* 0 */
    float world_from_object[3][4]; /* rows; at rest */
} hearth_pack_instance;

#define HEARTH_PACK_INSTANCE_INIT                                                                            \
    {                                                                                                        \
        sizeof(hearth_pack_instance), 0, 0, 0,                                                               \
        {                                                                                                    \
            {                                                                                                \
                0                                                                                            \
            }                                                                                                \
        }                                                                                                    \
    }

/* errors: USAGE, also if there is no such instance. */
HEARTH_API hearth_result hearth_pack_get_instance(const hearth_pack* pack, uint32_t index,
                                                  hearth_pack_instance* instance, char* message,
                                                  size_t message_size);

enum
{
    HEARTH_CAMERA_PERSPECTIVE = 0,
    HEARTH_CAMERA_ORTHOGRAPHIC = 1
};

/* Camera that the artist placed. */
typedef struct hearth_pack_camera
{
    uint32_t struct_size;
    uint32_t type;                 /* HEARTH_CAMERA_* */
    uint32_t node;                 /* source node */
    float aspect;                  /* width / height; 0: same as the frame */
    float half_width, half_height; /* metres; orthographic cameras only */
    float z_far;                   /* metres; 0: infinite */
    float world_from_camera[3][4]; /* rows; at rest; looks along -z */
    hearth_camera view;            /* for hearth_frame; y_fov_rad is 0 for an orthographic camera */
} hearth_pack_camera;

#define HEARTH_PACK_CAMERA_INIT                                                                              \
    {                                                                                                        \
        sizeof(hearth_pack_camera), HEARTH_CAMERA_PERSPECTIVE, 0, 0, 0, 0, 0, {{0}},                         \
        {                                                                                                    \
            {0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0, 0                                                           \
        }                                                                                                    \
    }

/* errors: USAGE, also if there is no such camera. */
HEARTH_API hearth_result hearth_pack_get_camera(const hearth_pack* pack, uint32_t index,
                                                hearth_pack_camera* camera, char* message,
                                                size_t message_size);

/* ---- Proxies (1.8), on any thread ----
 *
 * Simple meshes that stand for others: for collision, for sound, as occluders of the game's own. They are in the
 * object space and the bind pose of their mesh, and sorted by mesh. */

enum
{
    HEARTH_PROXY_CLEANED = 0, /* the mesh itself, repaired and decimated */
    HEARTH_PROXY_WRAPPED = 1, /* a closed surface around the mesh */
    HEARTH_PROXY_AUTHORED = 2 /* a mesh that an artist made for it */
};

/* Triangles with one material, or one convex part. */
typedef struct hearth_proxy_section
{
    uint32_t first_triangle;
    uint32_t triangle_count;
    uint32_t material;  /* record of HEARTH_TABLE_MATERIALS; UINT32_MAX: unknown */
    uint32_t is_convex; /* 1: a convex solid of its own; else 0 */
} hearth_proxy_section;

/* Place on a proxy that a vertex of the mesh belongs to. */
typedef struct hearth_proxy_binding
{
    uint32_t triangle;
    uint16_t weights[2]; /* barycentric weights of the second and third corner, over 65535 */
    float distance;      /* metres from the vertex to that place */
} hearth_proxy_binding;

/* Proxy of a mesh. Its arrays are valid while the pack is open. */
typedef struct hearth_proxy
{
    uint32_t struct_size;
    uint32_t mesh;
    uint32_t origin;     /* HEARTH_PROXY_* */
    uint32_t is_closed;  /* 1: it has no boundary, and an inside; else 0 */
    float distance;      /* metres: no point of the proxy is farther from the mesh; infinity: unknown */
    float mesh_distance; /* metres: no point of the mesh is farther from the proxy; infinity: unknown */
    uint32_t position_count;
    uint32_t index_count;   /* three a triangle */
    uint32_t section_count; /* sections hold all triangles, in order */
    uint32_t binding_count; /* 0, or one for each vertex of the mesh's first level, cluster by cluster */
    const float* positions; /* x, y and z of each; metres */
    const uint32_t* indices;
    const hearth_proxy_section* sections;
    const hearth_proxy_binding* bindings;
} hearth_proxy;

#define HEARTH_PROXY_INIT                                                                                    \
    {                                                                                                        \
        sizeof(hearth_proxy), 0, 0, 0, 0, 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL                              \
    }

/* errors: USAGE, also if there is no such proxy. */
HEARTH_API hearth_result hearth_pack_get_proxy(const hearth_pack* pack, uint32_t index, hearth_proxy* proxy,
                                               char* message, size_t message_size);

/* ---- Animation clips (1.2): played on the CPU, for a frame's moves, poses and lights (1.8). ---- */

/* Time in a clip, which holds its first key before it and its last key after it. */
typedef struct hearth_clip
{
    uint32_t animation; /* of the pack */
    uint32_t reserved;  /* 0 */
    double seconds;     /* finite */
} hearth_clip;

/* Create a player at rest. The pack outlives the player. errors: USAGE, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_player_create(hearth_pack* pack, hearth_player** player, char* message,
                                              size_t message_size);

/* errors: none. */
HEARTH_API hearth_result hearth_player_destroy(hearth_player* player);

/* Go to a pose of the whole scene. Allocates nothing.
 * from    NULL: at rest
 * to      a second clip to blend with, or NULL
 * weight  of the second clip, 0 to 1
 * errors: USAGE. */
HEARTH_API hearth_result hearth_player_go_to(hearth_player* player, const hearth_clip* from,
                                             const hearth_clip* to, double weight, char* message,
                                             size_t message_size);

/* Moves and poses that a frame needs to show the pose; valid until the next hearth_player_go_to. */
typedef struct hearth_player_info
{
    uint32_t struct_size;
    uint32_t move_count;
    const hearth_move* moves; /* rigid instances that the last go_to moved */
    const hearth_pose* poses; /* all deformed instances */
    uint32_t pose_count;
    uint32_t reserved; /* 0 */
} hearth_player_info;

#define HEARTH_PLAYER_INFO_INIT                                                                              \
    {                                                                                                        \
        sizeof(hearth_player_info), 0, NULL, NULL, 0, 0                                                      \
    }

/* errors: USAGE. */
HEARTH_API hearth_result hearth_player_get_info(const hearth_player* player, hearth_player_info* info);

/* Lights that clips, moving nodes and flicker change (1.8); valid until the next hearth_player_get_lights.
 * Pass either list as hearth_frame.lights. */
typedef struct hearth_player_lights
{
    uint32_t struct_size;
    uint32_t changed_count;
    /* lights that differ from the last call, or in the first call from the pack: for a scene that has had
     * all changes before */
    const hearth_light_change* changed;
    const hearth_light_change* lights; /* all that may change: for a new scene */
    uint32_t light_count;
    uint32_t reserved; /* 0 */
} hearth_player_lights;

#define HEARTH_PLAYER_LIGHTS_INIT                                                                            \
    {                                                                                                        \
        sizeof(hearth_player_lights), 0, NULL, NULL, 0, 0                                                    \
    }

/* Compute the lights of the pose that the last hearth_player_go_to went to (1.8). Allocates nothing.
 * flicker_seconds  time of flicker, finite; may run on where a clip loops. Equal times give equal lights.
 * errors: USAGE. */
HEARTH_API hearth_result hearth_player_get_lights(hearth_player* player, double flicker_seconds,
                                                  hearth_player_lights* lights, char* message,
                                                  size_t message_size);

/* ---- Queries (1.8): bounds, rays and picked pixels of a pack's instances where they stand, on the CPU ----
 *
 * Queries hold transforms and poses of their own, at rest at first: pass them the moves and poses of frames.
 * They need neither renderer nor scene. One thread at a time uses an object; a game may have several of a
 * pack. */

typedef struct hearth_queries_options
{
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    /* Decoded pages that are kept, at least one: rays that need others decode them, some 80 us each. */
    uint64_t page_bytes;
} hearth_queries_options;

#define HEARTH_QUERIES_OPTIONS_INIT                                                                          \
    {                                                                                                        \
        sizeof(hearth_queries_options), 0, 33554432                                                          \
    }

/* Create queries with all memory that they need, in a time linear in the clusters of the pack, which outlives
 * them. errors: USAGE, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_queries_create(hearth_pack* pack, const hearth_queries_options* options,
                                               hearth_queries** queries, char* message, size_t message_size);

/* errors: none. */
HEARTH_API hearth_result hearth_queries_destroy(hearth_queries* queries);

/* Move and pose instances, from now on, by the arrays of a frame, which are copied. Allocates nothing.
 * errors: USAGE; then nothing is moved. */
HEARTH_API hearth_result hearth_queries_place(hearth_queries* queries, const hearth_move* moves,
                                              uint32_t move_count, const hearth_pose* poses,
                                              uint32_t pose_count, char* message, size_t message_size);

/* Box in the world, metres; empty: min is above max. */
typedef struct hearth_box
{
    float min[3];
    float max[3];
} hearth_box;

/* Find the bounds of instances first to first + count - 1, together, where they stand. A pose that is not
 * free has the box around all poses of the clips, moved to the pose's place.
 * errors: USAGE. */
HEARTH_API hearth_result hearth_queries_get_bounds(const hearth_queries* queries, uint32_t first,
                                                   uint32_t count, hearth_box* box, char* message,
                                                   size_t message_size);

/* Find bounds of instances first to first + count - 1, together, over all times of a clip that is played
 * alone, in the world. Proven, and so larger than what the clip sweeps, where limbs are fast by tens of
 * percent. Takes milliseconds a clip, and memory for the time of the call. On any thread. errors: USAGE,
 * OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_pack_get_clip_bounds(const hearth_pack* pack, uint32_t animation,
                                                     uint32_t first, uint32_t count, hearth_box* box,
                                                     char* message, size_t message_size);

/* The points origin + t direction with t from t_min to t_max. */
typedef struct hearth_ray
{
    float origin[3];    /* world */
    float direction[3]; /* of any length above 0 */
    float t_min;        /* 0 or more */
    float t_max;        /* not below t_min; may be infinite */
} hearth_ray;

/* Point of a triangle. */
typedef struct hearth_hit
{
    uint32_t instance; /* UINT32_MAX: nothing was hit, and the rest is 0 */
    uint32_t node;     /* of the instance; with its name */
    uint32_t mesh;
    uint32_t material; /* UINT32_MAX: the default */
    uint32_t cluster;  /* of the pack */
    uint32_t triangle; /* of the cluster */
    float t;           /* of the ray */
    float weights[2];  /* barycentric weights of the triangle's second and third corner */
    float position[3]; /* world */
    float normal[3];   /* of the triangle's front side; unit, or 0 where the triangle has no area */
} hearth_hit;

/* Flags of hearth_cast. */
enum
{
    HEARTH_CAST_ANY = 1,        /* any hit in place of the nearest */
    HEARTH_CAST_FRONT_SIDES = 2 /* pass back sides where frames do not draw them: of one-sided materials */
};

typedef struct hearth_cast
{
    uint32_t struct_size;
    uint32_t flags; /* HEARTH_CAST_* */
    /* Of the pack, with a budget: rays meet the finest level that it holds since its last begin_frame. The call
     * uses it as others do, on its thread. NULL: the source's triangles. */
    const hearth_scene* scene;
    /* Called for hits in no order, nearer than those that it has accepted; 0: the ray goes on. Calls no
     * function of the library. NULL: all are accepted. */
    int (*accept)(void* user, const hearth_hit* hit);
    void* user;
} hearth_cast;

#define HEARTH_CAST_INIT                                                                                     \
    {                                                                                                        \
        sizeof(hearth_cast), 0, NULL, NULL, NULL                                                             \
    }

/* Cast rays: hits[i] gets the nearest hit of rays[i], or any. Whole triangles stop rays, also of masked and
 * blended materials. Neighbouring triangles leave no gap. Allocates nothing but some memory to decode pages,
 * once a thread.
 * cast    or NULL: the defaults
 * errors: USAGE; FILE_MALFORMED, if the pages that a ray needs are damaged. Then hits are not to be used. */
HEARTH_API hearth_result hearth_queries_cast_rays(hearth_queries* queries, const hearth_ray* rays,
                                                  uint32_t ray_count, const hearth_cast* cast,
                                                  hearth_hit* hits, char* message, size_t message_size);

/* Make the ray through a place of a frame's image, by its camera and its shift alone. Its t is the distance
 * along the view's axis, from z_near on, to z_far of an orthographic camera.
 * width, height  of the targets; above 0
 * x, y           pixels from the left and from the top; a pixel's center is at .5
 * errors: USAGE. */
HEARTH_API hearth_result hearth_frame_get_ray(const hearth_frame* frame, uint32_t width, uint32_t height,
                                               float x, float y, hearth_ray* ray, char* message,
                                               size_t message_size);

/* Record culling and drawing, outside a render pass. Clobbers compute and graphics state. Submit the frames
 * of a scene, and the frames with the same targets, to one queue for graphics and compute, in recording
 * order.
 * errors: USAGE, also if the targets belong to another scene. */
HEARTH_API hearth_result hearth_record_frame(hearth_scene* scene, hearth_targets* targets,
                                             VkCommandBuffer commands, const hearth_frame* frame);

/* Parts of a frame (1.1), for callers that put work between them. */
enum
{
    HEARTH_PART_CULL = 0,
    HEARTH_PART_VISIBILITY = 1,
    HEARTH_PART_MATERIALS = 2
};

/* Record a frame in parts, in place of hearth_record_frame: all three in this order, with the same targets
 * and frame, in one command buffer or in several of one queue. They synchronize with each other;
 * hearth_targets_get_part_info returns the image states before and after each. In scenes of few materials the parts
 * cost a tile-based GPU more: hearth_record_frame keeps the visibility buffer in the tile. errors: USAGE. */
HEARTH_API hearth_result hearth_record_cull(hearth_scene* scene, hearth_targets* targets,
                                            VkCommandBuffer commands, const hearth_frame* frame);
HEARTH_API hearth_result hearth_record_visibility(hearth_scene* scene, hearth_targets* targets,
                                                  VkCommandBuffer commands, const hearth_frame* frame);
HEARTH_API hearth_result hearth_record_materials(hearth_scene* scene, hearth_targets* targets,
                                                 VkCommandBuffer commands, const hearth_frame* frame);

/* Use of an image of the targets by a part; stages 0: the part does not touch it. */
typedef struct hearth_image_use
{
    hearth_image_state before; /* the part waits for such uses; layout UNDEFINED: the content is lost */
    hearth_image_state after;  /* state after the part, visible to these accesses */
} hearth_image_use;

typedef struct hearth_part_info
{
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    hearth_image_use color;
    hearth_image_use visibility;
} hearth_part_info;

#define HEARTH_PART_INFO_INIT                                                                                \
    {                                                                                                        \
        sizeof(hearth_part_info), 0, {{VK_IMAGE_LAYOUT_UNDEFINED, 0, 0}, {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0}}, \
        {                                                                                                    \
            {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0},                                                               \
            {                                                                                                \
                VK_IMAGE_LAYOUT_UNDEFINED, 0, 0                                                              \
            }                                                                                                \
        }                                                                                                    \
    }

/* part  HEARTH_PART_*; the same for all frames with the targets. errors: USAGE. */
HEARTH_API hearth_result hearth_targets_get_part_info(const hearth_targets* targets, uint32_t part,
                                                      hearth_part_info* info);

/* Describe the passes of a frame as JSON (1.8): what each loads, reads, writes and stores, bytes a pixel with
 * merged subpasses ("low") and without ("high"), and what tile-based GPUs punish. Each shadow map that is
 * stale by the camera is a pass, in bytes a texel; moves, poses, lights and shadow spheres of the frame do not
 * count. Records nothing. Writes at most `size` bytes with the terminating zero; `needed` gets the size of the whole
 * text.
 * json  or NULL, with size 0. errors: USAGE. */
HEARTH_API hearth_result hearth_describe_passes(const hearth_scene* scene, const hearth_targets* targets,
                                                const hearth_frame* frame, char* json, size_t size,
                                                size_t* needed);

/* Record a count of what a frame with HEARTH_OCCLUSION_LAST_FRAME left out (1.8), after it and before the scene's
 * next frame: of the counters, drawn_clusters - early_clusters are clusters that the earlier frame's depth hid
 * and this one's does not. The targets have HEARTH_TARGETS_COUNT_MISSING. errors: USAGE. */
HEARTH_API hearth_result hearth_record_missing(hearth_scene* scene, hearth_targets* targets,
                                               VkCommandBuffer commands);

/* Record the motion vectors of a whole frame (1.8), after it and before the scene's next frame: a pixel of
 * hearth_targets_info.motion gets the place in the frame before with these targets of what it shows, less its
 * own place. In pixels, to the right and downwards: added to a pixel, the vector leads to where to read the
 * frame before. hearth_frame.shift is left out of both frames, so that jitter is no motion. The sky moves as
 * the camera turns. The vector is (32768, 32768) for what was behind the camera, 0 everywhere in the first
 * frame of the targets; others are at most 16384 in each direction.
 * Moves and poses count from step to step of the scene. A step ends before a frame with targets that have
 * had one in it: draw each of several cameras with HEARTH_TARGETS_MOTION once a step, and pass moves and poses
 * with the first of them.
 * Outside a render pass; clobbers graphics state. On tile-based GPUs it costs 12 bytes a pixel: 4 to store
 * the visibility buffer, 4 to read it, 4 for the vectors. Needs HEARTH_SCENE_MOTION and
 * HEARTH_TARGETS_MOTION.
 * errors: USAGE. */
HEARTH_API hearth_result hearth_record_motion(hearth_scene* scene, hearth_targets* targets,
                                              VkCommandBuffer commands);

/* Frames after which the shifts of hearth_get_jitter repeat (1.8): what rests has the mean of them all. */
#define HEARTH_JITTER_FRAMES 32u

/* Get the jitter of frame `number` for temporal anti-aliasing (1.8), up to half a pixel each way, to be added
 * to hearth_frame.shift. The same on every device.
 * width, height  of the targets; above 0
 * errors: USAGE. */
HEARTH_API hearth_result hearth_get_jitter(uint32_t number, uint32_t width, uint32_t height, float* shift_x,
                                           float* shift_y, char* message, size_t message_size);

/* Record temporal anti-aliasing of a whole frame (1.8), after hearth_record_motion of the frame: draws
 * hearth_targets_info.filtered, the mean of this frame and of those before that motion vectors lead to, where
 * their colours fit the pixel's neighbours and nothing hid what it shows. Filters frames behind exposure,
 * bloom and tone curve, so that no sample outshines the others of its pixel. Frames have the shifts of
 * hearth_get_jitter, one after the other. A frame whose frame before with these targets was not filtered is
 * drawn as it is.
 * reset  1: leave earlier frames out, as after a cut: the frame is drawn as it is; or 0
 * Outside a render pass; clobbers graphics state. On tile-based GPUs it costs 40 bytes a pixel beside those of
 * the motion vectors: distances (4 written, 8 read), vectors and frame (4 read each), history (8 read, 8
 * written), the filtered frame (4 written). errors: USAGE. */
HEARTH_API hearth_result hearth_record_anti_aliasing(hearth_scene* scene, hearth_targets* targets,
                                                     VkCommandBuffer commands, uint32_t reset);

/* Record the page requests of a frame of a scene with a budget, without drawing. Moves nothing. To prefetch a
 * view, record such frames until settled_serial reaches the serial of the first of them. errors: USAGE. */
HEARTH_API hearth_result hearth_record_prefetch(hearth_scene* scene, hearth_targets* targets,
                                                VkCommandBuffer commands, const hearth_frame* frame);

/* Counters of a frame in buffer memory. */
typedef struct hearth_frame_counters
{
    uint32_t drawn_clusters;   /* passed all tests */
    uint32_t dropped_clusters; /* the last of them, beyond max_visible_clusters: not drawn */
    uint32_t early_clusters;   /* the first of them, not occluded by the last frame's depth */
    uint32_t reserved;
} hearth_frame_counters;

/* Record a copy of the counters of the last recorded frame to `offset` (a multiple of 4) of a buffer of the
 * caller (usage TRANSFER_DST), visible to the host once the commands have completed. errors: USAGE. */
HEARTH_API hearth_result hearth_record_counters(hearth_scene* scene, VkCommandBuffer commands,
                                                VkBuffer destination, VkDeviceSize offset);

/* Pixels that one hearth_record_picks looks at, at most (1.8). */
#define HEARTH_MAX_PICKS 4096u

/* Triangle that a pixel shows (1.8): hearth_queries_find_pick returns the point. */
typedef struct hearth_pick
{
    uint32_t instance; /* UINT32_MAX: the sky */
    uint32_t cluster;
    uint32_t triangle; /* of the cluster */
    uint32_t reserved; /* 0 */
} hearth_pick;

/* Pixels x to x + width - 1 and y to y + height - 1 of the targets' `width` and `height`. */
typedef struct hearth_pixels
{
    uint32_t x, y;
    uint32_t width, height; /* above 0; together HEARTH_MAX_PICKS at most */
} hearth_pixels;

/* Record a copy of what pixels of a whole frame show (1.8), after it and before the scene's next frame: a
 * hearth_pick each, row by row from the top, to `offset` (a multiple of 4) of a buffer of the caller (usage
 * TRANSFER_DST), visible to the host once the commands have completed. Outside a render pass; clobbers
 * compute state. Needs hearth_scene_prepare_picks, and targets with HEARTH_TARGETS_KEEP_VISIBILITY, which on
 * tile-based GPUs costs 4 bytes a pixel to store; without it, cast a ray (hearth_frame_get_ray).
 * errors: USAGE. */
HEARTH_API hearth_result hearth_record_picks(hearth_scene* scene, hearth_targets* targets,
                                             VkCommandBuffer commands, const hearth_pixels* pixels,
                                             VkBuffer destination, VkDeviceSize offset);

/* Find the point of the pick of pixel (x, y) that the pixel's center shows (1.8): hearth_hit as of the ray
 * through it. The instances stand as in the frame (hearth_queries_place). Waits for nothing.
 * frame          its camera and its shift; all else is ignored
 * width, height  of the targets
 * errors: USAGE, also if there is no such triangle; FILE_MALFORMED, if the page of the triangle is
 * damaged. */
HEARTH_API hearth_result hearth_queries_find_pick(hearth_queries* queries, const hearth_frame* frame,
                                                  uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                                                  const hearth_pick* pick, hearth_hit* hit, char* message,
                                                  size_t message_size);

#endif
