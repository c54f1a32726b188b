/* SPDX-License-Identifier: LicenseRef-Hearth-Undecided
 *
 * The runtime as a C library: opens packs, uploads scenes, records frames into the caller's command buffers.
 * README.md has a whole program. What is said here once holds for every call:
 *
 * - The caller owns instance, device, queue, command buffers and their submission. Nothing is submitted or waited for, no
 *   thread is started, and there are no globals. Vulkan 1.1 without optional features is enough.
 * - A call returns HEARTH_OK, or why it changed nothing. Its message, one line with what to do, is that of
 *   hearth_last_error, or goes to `message` (message_size bytes; may be NULL and 0) where a call has no renderer.
 *   hearth_pack_close leaves its message to hearth_pack_last_error. Messages are written by calls that fail only.
 *   Where a handle is NULL there is but the result.
 * - Structs begin with their size, which the HEARTH_..._INIT macros set beside the defaults. Structs in arrays, and those
 *   that stand inside others, have no size and never change.
 * - A renderer and all that is made from it are used by one thread at a time; hearth_read_done, and packs while they are
 *   open, by any number of threads. Nothing is thrown; callbacks must not throw.
 * - What is made from something is destroyed before it, and after the frames that use it have completed. Destroying NULL
 *   does nothing.
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

/* Major version << 16 | minor version. A library takes callers of its major version and of no later minor version. */
#define HEARTH_API_VERSION 0x00010006u

typedef int32_t hearth_result;
enum
{
    HEARTH_OK = 0,
    HEARTH_ERROR_USAGE = 1,            /* an argument, or the order of calls, breaks a rule of this header */
    HEARTH_ERROR_IN_USE = 2,           /* something that was made from it is alive; the message counts it */
    HEARTH_ERROR_FILE_MISSING = 3,     /* a file does not exist or cannot be read */
    HEARTH_ERROR_FILE_MALFORMED = 4,   /* a file is damaged, of another kind or of another version */
    HEARTH_ERROR_READ = 5,             /* reading failed half way */
    HEARTH_ERROR_DEVICE = 6,           /* the device lacks what the renderer needs */
    HEARTH_ERROR_DEVICE_FAILED = 7,    /* a Vulkan call failed */
    HEARTH_ERROR_DEVICE_LIMIT = 8,     /* the scene or the picture is too large for the device */
    HEARTH_ERROR_STREAMING_BUDGET = 9, /* the geometry that must stay exceeds the budget */
    HEARTH_ERROR_OUT_OF_MEMORY = 10,   /* of the CPU */
    HEARTH_ERROR_INTERNAL = 11         /* a defect of Hearth */
};

typedef struct hearth_pack hearth_pack;
typedef struct hearth_renderer hearth_renderer;
typedef struct hearth_scene hearth_scene;
typedef struct hearth_targets hearth_targets;
typedef struct hearth_player hearth_player; /* since 1.2 */

/* HEARTH_API_VERSION of the library. */
HEARTH_API uint32_t hearth_api_version(void);

/* What a result means, in English; never NULL. */
HEARTH_API const char* hearth_result_string(hearth_result result);

/* ---- Packs ---- */

/* Maps the file and checks its tables. Geometry and texels are not read: they are checked when they are, so that uploads
 * and reads of pages of a damaged or hostile file fail, and nothing of it is drawn.
 * errors: USAGE, FILE_MISSING, FILE_MALFORMED, READ, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_pack_open(const char* path, hearth_pack** pack, char* message,
                                          size_t message_size);

/* The same on bytes that outlive the pack. `bytes` is aligned to 64; `name` stands in messages. */
HEARTH_API hearth_result hearth_pack_open_memory(const void* bytes, size_t size, const char* name,
                                                 hearth_pack** pack, char* message, size_t message_size);

/* Checks the whole file at once (1.5), as `hearth verify` does: one pass over it. For those who would rather know before they
 * draw; on any thread, beside everything else.
 * errors: USAGE, FILE_MALFORMED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_pack_check(const hearth_pack* pack, char* message, size_t message_size);

/* Decodes a page into `destination`, of at least the page's size, after it was checked. `destination` is written from front
 * to back and not read. For hearth_read_page; on any thread.
 * errors: USAGE, OUT_OF_MEMORY; FILE_MALFORMED where the page is not what its pack promises: `destination` is left alone. */
HEARTH_API hearth_result hearth_pack_read_page(const hearth_pack* pack, uint32_t page, void* destination,
                                               size_t size, char* message, size_t message_size);

/* The clip of this name, or else of this number (1.2). `seconds` gets its length, unless it is NULL.
 * errors: USAGE, also where there is none. */
HEARTH_API hearth_result hearth_pack_find_animation(const hearth_pack* pack, const char* name,
                                                    uint32_t* animation, double* seconds, char* message,
                                                    size_t message_size);

/* errors: IN_USE, while scenes or players that were made from it are alive. */
HEARTH_API hearth_result hearth_pack_close(hearth_pack* pack);

/* The message of the last hearth_pack_close of the pack that failed (1.6); "" where none did. */
HEARTH_API const char* hearth_pack_last_error(const hearth_pack* pack);

/* ---- Renderer ---- */

enum
{
    HEARTH_FEATURE_SAMPLER_ANISOTROPY = 1, /* the caller enabled samplerAnisotropy: it shall be used */
    HEARTH_FEATURE_OVERDRAW = 2,           /* make the pipelines of HEARTH_SHOW_OVERDRAW */
    HEARTH_FEATURE_DEBUG_LABELS = 4 /* 1.1: the caller enabled VK_EXT_debug_utils: passes shall have names */
};

/* What memory is for. */
enum
{
    HEARTH_MEMORY_DEVICE = 0,  /* fastest for the GPU; not mapped */
    HEARTH_MEMORY_STAGING = 1, /* mapped and coherent, written by the CPU */
    HEARTH_MEMORY_READBACK = 2 /* mapped and coherent, read by the CPU; cached where there is such memory */
};

/* Of one buffer or image. */
typedef struct hearth_memory_request
{
    VkMemoryRequirements needs;
    uint32_t kind;     /* HEARTH_MEMORY_* */
    uint32_t is_image; /* 1: optimally tiled; bufferImageGranularity is the allocator's to keep */
} hearth_memory_request;

typedef struct hearth_memory_piece
{
    VkDeviceMemory memory;
    VkDeviceSize offset;
    void* mapped;     /* where the piece begins, of kinds that are mapped; until it is freed */
    void* allocation; /* the allocator's own */
} hearth_memory_piece;

/* Device memory from the caller: both functions or none. Called by calls that create and destroy, on their thread. `allocate`
 * gives a piece of a type that `needs` allows, with the properties of the kind. Nothing uses what is bound to a piece any
 * more when it is freed. */
typedef struct hearth_memory_hooks
{
    void* user;
    VkResult (*allocate)(void* user, const hearth_memory_request* request, hearth_memory_piece* piece);
    void (*free)(void* user, const hearth_memory_piece* piece);
} hearth_memory_hooks;

/* What is degraded and no error, in one line: lights that are left out, pages that cannot be read. On the thread of the call
 * that finds it; must not call the library. */
typedef void (*hearth_message)(void* user, const char* message);

typedef struct hearth_renderer_description
{
    uint32_t struct_size;
    uint32_t api_version; /* HEARTH_API_VERSION, as the caller was compiled */
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    const VkAllocationCallbacks* allocator; /* or NULL */
    VkPipelineCache pipeline_cache;         /* or VK_NULL_HANDLE */
    uint32_t features;                      /* HEARTH_FEATURE_* */
    uint32_t reserved;                      /* 0 */
    /* since 1.1 */
    hearth_memory_hooks memory; /* or NULLs: blocks from vkAllocateMemory */
    hearth_message message;     /* or NULL */
    void* message_user;
} hearth_renderer_description;

#define HEARTH_RENDERER_DESCRIPTION_INIT                                                                     \
    {                                                                                                        \
        sizeof(hearth_renderer_description), HEARTH_API_VERSION, NULL, VK_NULL_HANDLE, VK_NULL_HANDLE,       \
            VK_NULL_HANDLE, NULL, VK_NULL_HANDLE, 0, 0, {NULL, NULL, NULL}, NULL, NULL                       \
    }

/* Makes pipelines: seconds on some devices. What the description names outlives the renderer.
 * errors: USAGE, DEVICE, DEVICE_FAILED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_renderer_create(const hearth_renderer_description* description,
                                                hearth_renderer** renderer, char* message,
                                                size_t message_size);

/* errors: IN_USE, while scenes or targets that were made from it are alive. */
HEARTH_API hearth_result hearth_renderer_destroy(hearth_renderer* renderer);

/* The message of the last call that failed on the renderer or what was made from it; "" where none did. Holds until the
 * next call. */
HEARTH_API const char* hearth_last_error(const hearth_renderer* renderer);

/* ---- Scenes ---- */

/* A page to be read. To be handed to hearth_read_done once. */
typedef struct hearth_read
{
    unsigned char internal[16];
} hearth_read;

/* Starts to read a page: its `size` decoded bytes into `destination`, as hearth_pack_read_page does, then
 * hearth_read_done. May do so at once or later, on any thread, reads in any order. Called by hearth_scene_begin_frame. */
typedef void (*hearth_read_page)(void* user, uint32_t page, void* destination, size_t size, hearth_read read);

/* The read has ended; `ok` is 0 where it failed. The destination is not touched afterwards. From any thread. */
HEARTH_API void hearth_read_done(hearth_read read, int ok);

/* Shadow maps of suns and spots. See README.md of runtime/gpu, "Shadows". */
typedef struct hearth_shadow_options
{
    uint32_t max_maps; /* of a frame, up to 64. 0: no shadows, and the rest is not looked at */
    uint32_t texels;   /* of a map each way, 4 bytes each: a power of two from 4 * (kernel + 1) to 8192 */
    uint32_t kernel;   /* texels that the filter reads on each side, up to 3: 1 is 3 x 3 */
    uint32_t splits;   /* maps of each sun that follow the view, up to 8 */
    uint32_t moving_layers;      /* 1: what has moved is drawn over what rests, in as many maps more; or 0 */
    float error_bias;            /* by how many times a shadow may be coarser than the picture, 1 or more */
    float split_near, split_far; /* metres from the eye, where the splits begin and end; 0 < near < far */
    float split_blend;           /* 0: splits of equal length, 1: each so many times the one before */
    float spot_near;             /* metres, above 0: what is nearer to a spot light casts no shadow */
} hearth_shadow_options;

#define HEARTH_SHADOW_OPTIONS_INIT                                                                           \
    {                                                                                                        \
        0, 1024, 1, 4, 1, 2, 0.1f, 100, 0.8f, 0.05f                                                          \
    }

typedef struct hearth_scene_options
{
    uint32_t struct_size;
    /* Most clusters of a frame, 1 to 33554430, 8 bytes each; more are counted and not drawn (hearth_frame_counters). */
    uint32_t max_visible_clusters;
    /* Bytes of geometry on the device; more are streamed by `read`. 0: all of it, at most 512 MiB. */
    uint64_t geometry_budget;
    /* Needed with a budget. All reads have ended, or never will, before the scene is destroyed. */
    hearth_read_page read;
    void* read_user;
    uint32_t
        max_loads; /* reads at once, 1 to 1024; up to 128 KiB of staging memory each, beside the budget */
    uint32_t
        frames_in_flight; /* that are recorded while earlier ones run, 1 to 16; more are not listened to */
    hearth_shadow_options shadows;
    /* since 1.2: bytes for the vertices of deformed clusters, which are skinned once a frame; what does not fit is skinned
     * wherever it is needed, with the same picture */
    uint64_t skinning_bytes;
} hearth_scene_options;

#define HEARTH_SCENE_OPTIONS_INIT                                                                            \
    {                                                                                                        \
        sizeof(hearth_scene_options), 4194304, 0, NULL, NULL, 32, 3, HEARTH_SHADOW_OPTIONS_INIT, 16777216    \
    }

/* Records the copies of a scene. Where it fails, `commands` is to be thrown away. The pack outlives the scene.
 * errors: USAGE, FILE_MALFORMED, DEVICE_FAILED, DEVICE_LIMIT, STREAMING_BUDGET, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_scene_upload(hearth_renderer* renderer, hearth_pack* pack,
                                             VkCommandBuffer commands, const hearth_scene_options* options,
                                             hearth_scene** scene);

/* The commands of the upload have completed: frees its staging memory. */
HEARTH_API hearth_result hearth_scene_uploaded(hearth_scene* scene);

/* errors: none. */
HEARTH_API hearth_result hearth_scene_destroy(hearth_scene* scene);

typedef struct hearth_scene_information
{
    uint32_t struct_size;
    uint32_t instance_count;
    uint32_t dropped_lights; /* lights beyond what is drawn */
    uint32_t reserved;       /* 0 */
    float box_min[3]; /* of the instances as they were loaded; above box_max where there is nothing to draw */
    float box_max[3];
    uint64_t allocated_bytes; /* of device memory, staging memory of streaming included */
} hearth_scene_information;

#define HEARTH_SCENE_INFORMATION_INIT                                                                        \
    {                                                                                                        \
        sizeof(hearth_scene_information), 0, 0, 0, {0, 0, 0}, {0, 0, 0}, 0                                   \
    }

HEARTH_API hearth_result hearth_scene_inform(const hearth_scene* scene,
                                             hearth_scene_information* information);

/* ---- Streaming ---- */

/* For each frame of a scene with a budget: takes what was read, starts reads. A record call must follow.
 * serial            of the frame: greater than that of the one before, at least 1
 * completed_serial  no frame up to this one runs any more; below serial, and never decreases */
HEARTH_API hearth_result hearth_scene_begin_frame(hearth_scene* scene, uint64_t serial,
                                                  uint64_t completed_serial);

typedef struct hearth_stream_counters
{
    uint32_t struct_size;
    float error_scale;       /* on thresholds: above 1 where what is wanted exceeds the budget */
    uint64_t budget_bytes;   /* rounded down to what pages can use */
    uint64_t bytes_in_use;   /* of the budget */
    uint64_t bytes_resident; /* of decoded pages */
    uint64_t bytes_streamed; /* so far */
    uint64_t settled_serial; /* the last frame that drew all that it wanted and could get; 0: none yet */
    uint32_t pages_resident;
    uint32_t reads_in_flight; /* started, and not seen to end by a frame */
    uint32_t failures;        /* so far */
    uint32_t failed_page_count;
    const uint32_t* failed_pages; /* whose failure the last begin_frame saw, each once; until the next one */
} hearth_stream_counters;

#define HEARTH_STREAM_COUNTERS_INIT                                                                          \
    {                                                                                                        \
        sizeof(hearth_stream_counters), 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, NULL                                   \
    }

/* errors: USAGE, also where the scene has no budget. */
HEARTH_API hearth_result hearth_scene_stream(const hearth_scene* scene, hearth_stream_counters* counters);

/* Pages that failed may be tried again. errors: USAGE, also where the scene has no budget. */
HEARTH_API hearth_result hearth_scene_retry_failed(hearth_scene* scene);

/* ---- Shadows ---- */

/* Of the last frame that was recorded. */
typedef struct hearth_shadow_counters
{
    uint32_t struct_size;
    uint32_t maps;              /* in use */
    uint32_t drawn_maps;        /* of these, drawn by the frame; the others were kept */
    uint32_t moved_maps;        /* of these, in which the frame drew what moves */
    uint32_t dropped_maps;      /* beyond max_maps */
    uint32_t unshadowed_lights; /* suns and spots without a map */
} hearth_shadow_counters;

#define HEARTH_SHADOW_COUNTERS_INIT                                                                          \
    {                                                                                                        \
        sizeof(hearth_shadow_counters), 0, 0, 0, 0, 0                                                        \
    }

/* errors: USAGE, also where the scene has no shadows. */
HEARTH_API hearth_result hearth_scene_shadows(const hearth_scene* scene, hearth_shadow_counters* counters);

/* ---- Targets: the images of a frame. Each camera has its own: they remember what it saw. ----
 *
 * They belong to the scene that is first recorded with them, until it is destroyed: a frame draws one scene, and a
 * second one would draw over the picture. To record another scene with them is an error. hearth_record_prefetch,
 * which draws nothing, takes the targets of any scene. */

/* width, height  1 to what the device can render; pixels
 * errors: USAGE, DEVICE_LIMIT, DEVICE_FAILED, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_targets_create(hearth_renderer* renderer, uint32_t width, uint32_t height,
                                               hearth_targets** targets);

HEARTH_API hearth_result hearth_targets_destroy(hearth_targets* targets);

/* What a barrier must know of an image. */
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
    hearth_image_state before; /* a frame waits for such uses of the image; its content is lost */
    hearth_image_state after;  /* a frame leaves it so, visible to these accesses */
} hearth_image;

typedef struct hearth_targets_information
{
    uint32_t struct_size;
    uint32_t width, height;  /* pixels */
    uint32_t reserved;       /* 0 */
    hearth_image color;      /* R8G8B8A8_SRGB */
    hearth_image visibility; /* R32_UINT: slot of the visible list << 7 | triangle, or 0xFFFFFFFF */
    uint64_t allocated_bytes;
} hearth_targets_information;

#define HEARTH_IMAGE_INIT                                                                                    \
    {                                                                                                        \
        VK_NULL_HANDLE, VK_FORMAT_UNDEFINED, {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0},                              \
        {                                                                                                    \
            VK_IMAGE_LAYOUT_UNDEFINED, 0, 0                                                                  \
        }                                                                                                    \
    }
#define HEARTH_TARGETS_INFORMATION_INIT                                                                      \
    {                                                                                                        \
        sizeof(hearth_targets_information), 0, 0, 0, HEARTH_IMAGE_INIT, HEARTH_IMAGE_INIT, 0                 \
    }

HEARTH_API hearth_result hearth_targets_inform(const hearth_targets* targets,
                                               hearth_targets_information* information);

/* ---- Frames ---- */

/* What is left out; the picture is the same. */
enum
{
    HEARTH_CULL_INSTANCES = 1,
    HEARTH_CULL_FRUSTUM = 2,
    HEARTH_CULL_CONE = 4,
    HEARTH_CULL_OCCLUSION = 8,
    HEARTH_CULL_EVERYTHING = 15
};

/* What the picture shows. */
enum
{
    HEARTH_SHOW_FINAL = 0,
    HEARTH_SHOW_CLUSTERS = 1,
    HEARTH_SHOW_LOD = 2,
    HEARTH_SHOW_TRIANGLES = 3,
    HEARTH_SHOW_NORMALS = 4,
    HEARTH_SHOW_DEPTH = 5,
    HEARTH_SHOW_MATERIALS = 6,
    HEARTH_SHOW_ERROR = 7,
    HEARTH_SHOW_CONES = 8,
    HEARTH_SHOW_OVERDRAW = 9,     /* needs HEARTH_FEATURE_OVERDRAW */
    HEARTH_SHOW_SHADOW_MAPS = 10, /* which is looked up; needs a scene with shadows */
    HEARTH_SHOW_BONES = 11,       /* 1.2: main bones of characters */
    /* 1.3: of packs with visibility; dark red where a mesh has none */
    HEARTH_SHOW_AMBIENT_OCCLUSION = 12,
    HEARTH_SHOW_BENT_NORMAL = 13,        /* axis of the visibility cone */
    HEARTH_SHOW_APERTURE = 14,           /* its half-angle, white: 90 degrees */
    HEARTH_SHOW_SPECULAR_OCCLUSION = 15, /* as the eye sees it */
    /* 1.4: need a scene whose pack has bricks */
    HEARTH_SHOW_BRICKS = 16,         /* the voxels that a pixel's ray meets first, by their albedo */
    HEARTH_SHOW_BRICK_LIGHTING = 17, /* the same by the light that they send out */
    HEARTH_SHOW_GATHERED = 18        /* the light of bricks alone, on white surfaces */
};

/* How much of the sky's light reaches a surface, in packs with visibility (1.3). */
enum
{
    HEARTH_AMBIENT_OCCLUSION_EXACT = 0,
    HEARTH_AMBIENT_OCCLUSION_SMOOTHSTEP = 1,
    HEARTH_AMBIENT_OCCLUSION_QUADRATIC = 2,
    HEARTH_AMBIENT_OCCLUSION_OFF = 3
};

/* The same of its mirror image (1.3). */
enum
{
    HEARTH_SPECULAR_OCCLUSION_FIT = 0,
    HEARTH_SPECULAR_OCCLUSION_TABLE = 1, /* the pack's; where it has none, the fit */
    HEARTH_SPECULAR_OCCLUSION_OFF = 2
};

/* Where each material is shaded; the picture is the same. */
enum
{
    HEARTH_SHADE_AUTOMATIC = 0,
    HEARTH_SHADE_WHOLE_PICTURE = 1,
    HEARTH_SHADE_TILES = 2
};

/* A timestamp is written at the begin of a frame and after each pass. */
enum
{
    HEARTH_TIMESTAMP_BEGIN = 0,
    HEARTH_TIMESTAMP_SHADOWS =
        1, /* with the light of bricks' faces; no time without shadow maps to draw and bricks */
    HEARTH_TIMESTAMP_CULL = 2,
    HEARTH_TIMESTAMP_EARLY_VISIBILITY = 3, /* it and the two after it: no time without occlusion culling */
    HEARTH_TIMESTAMP_PYRAMID = 4,
    HEARTH_TIMESTAMP_LATE_CULL = 5,
    HEARTH_TIMESTAMP_VISIBILITY = 6,
    HEARTH_TIMESTAMP_MATERIAL_TILES = 7, /* with the gathering of bricks' light */
    HEARTH_TIMESTAMP_MATERIAL_DEPTH = 8,
    HEARTH_TIMESTAMP_SHADING = 9,
    HEARTH_TIMESTAMP_COUNT = 10
};

/* A perspective camera. The far plane is infinite, depth = z_near / distance along the view. */
typedef struct hearth_camera
{
    float position[3];
    float target[3]; /* any point that the middle of the picture shows */
    float up[3];
    float y_fov_rad; /* full vertical angle, above 0 and below pi */
    float z_near;    /* metres, above 0 */
} hearth_camera;

/* How much errors count at a distance: linear between knots, constant beyond the first and the last. */
typedef struct hearth_lod_knot
{
    float distance; /* metres from the eye, 0 or more, more than that of the knot before */
    /* Above 1 is finer. Within 8 times that of the knot before; grows no faster than the distance. */
    float factor;
} hearth_lod_knot;

/* A new place of an instance, for this frame and those after it. */
typedef struct hearth_move
{
    uint32_t instance;
    float world_from_object[3][4]; /* rows; finite */
} hearth_move;

/* An affine transform in double precision, rows (1.2). */
typedef struct hearth_transform
{
    double m[3][4];
} hearth_transform;

/* A new pose of an instance whose mesh has joints or morph targets, for this frame and those after it (1.2). */
typedef struct hearth_pose
{
    uint32_t instance;
    uint32_t joint_count;                    /* of its skin; 1 without a skin */
    const hearth_transform* world_from_bind; /* for each joint; without a skin that of the node; finite */
    const float* morph_weights;              /* finite */
    uint32_t morph_weight_count;             /* the morph targets of its mesh */
    /* 1: not of the pack's clips, nor between two of them (ragdoll, inverse kinematics, weights outside of 0 to 1): culled
     * by where the joints are, which finds less; or 0 */
    uint32_t free_pose;
} hearth_pose;

#define HEARTH_ALL_LIGHTS 0xFFFFFFFFu

/* Where shadows are finer, beside the spheres of the pack: a map of its own. */
typedef struct hearth_shadow_sphere
{
    float center[3]; /* world */
    float radius;    /* metres, above 0 */
    uint32_t light;  /* of the pack, or HEARTH_ALL_LIGHTS */
    uint32_t
        texels; /* of its map each way, rounded down to a power of two; 0: hearth_shadow_options.texels, the most */
} hearth_shadow_sphere;

/* What a light of the pack is from this frame on (1.4); its type stays. All finite. */
typedef struct hearth_light_change
{
    uint32_t light;
    float world_from_light[3][4]; /* rows; it shines along -z */
    float color[3];               /* linear */
    float intensity;              /* candela; lux of a sun; 0: off */
    float range;                  /* metres; 0: unlimited */
    float inner_cone_rad;         /* of a spot */
    float outer_cone_rad;
} hearth_light_change;

/* Inside a box of the world the faces of bricks glow `factor` times as bright as the pack says (1.4). */
typedef struct hearth_emission_scale
{
    float box_min[3];
    float box_max[3];
    float factor; /* 0 or more */
} hearth_emission_scale;

typedef struct hearth_frame
{
    uint32_t struct_size;
    uint32_t cull_flags; /* HEARTH_CULL_* */
    hearth_camera camera;
    float error_pixels;               /* projected error that need not be refined; 0: the source triangles */
    const hearth_lod_knot* lod_knots; /* read while recording */
    uint32_t lod_knot_count;          /* 0 to 8; 0: errors count alike everywhere */
    uint32_t move_count;
    const hearth_move* moves;     /* read while recording; an instance at most once */
    uint32_t shown;               /* HEARTH_SHOW_* */
    float depth_scale;            /* metres that HEARTH_SHOW_DEPTH shows as middle grey, above 0 */
    uint32_t shaded_area;         /* HEARTH_SHADE_* */
    uint32_t shadow_sphere_count; /* of a scene with shadows; else they are not looked at */
    const hearth_shadow_sphere* shadow_spheres; /* all of this frame; read while recording */
    VkQueryPool timestamps; /* of HEARTH_TIMESTAMP_COUNT timestamps, reset by the frame; or VK_NULL_HANDLE */
    /* since 1.2 */
    const hearth_pose* poses; /* read while recording; an instance at most once */
    uint32_t pose_count;
    /* since 1.3 */
    uint32_t ambient_occlusion;  /* HEARTH_AMBIENT_OCCLUSION_* */
    uint32_t specular_occlusion; /* HEARTH_SPECULAR_OCCLUSION_* */
    /* since 1.4 */
    uint32_t constant_sky;                  /* 1: the sky lights all alike, whatever bricks there are; or 0 */
    const hearth_light_change* lights;      /* read while recording */
    const hearth_emission_scale* emissions; /* all of this frame; read while recording */
    uint32_t light_count;
    uint32_t emission_count; /* up to 8 */
} hearth_frame;

#define HEARTH_FRAME_INIT                                                                                    \
    {                                                                                                        \
        sizeof(hearth_frame), HEARTH_CULL_EVERYTHING, {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.8f, 0.01f}, 1,    \
            NULL, 0, 0, NULL, HEARTH_SHOW_FINAL, 1, HEARTH_SHADE_AUTOMATIC, 0, NULL, VK_NULL_HANDLE, NULL,   \
            0, HEARTH_AMBIENT_OCCLUSION_EXACT, HEARTH_SPECULAR_OCCLUSION_FIT, 0, NULL, NULL, 0, 0            \
    }

/* ---- Tables of a pack (1.6), on any thread. Moves, poses, clips and light changes name records by these numbers. ---- */

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
    HEARTH_TABLE_ANIMATIONS = 8
};

/* Counts the records of a table (HEARTH_TABLE_*). errors: USAGE. */
HEARTH_API hearth_result hearth_pack_get_count(const hearth_pack* pack, uint32_t table, uint32_t* count,
                                               char* message, size_t message_size);

/* A name in UTF-8, which holds while the pack is open. No zero ends it: print it by "%.*s", length, text. */
typedef struct hearth_name
{
    const char* text; /* not NULL */
    size_t length;    /* bytes; 0: the source gave no name */
} hearth_name;

/* Reads the name of a record; an instance has the name of its node. Several records may have one name.
 * errors: USAGE, also where there is no such record. */
HEARTH_API hearth_result hearth_pack_get_name(const hearth_pack* pack, uint32_t table, uint32_t index,
                                              hearth_name* name, char* message, size_t message_size);

/* A mesh that is drawn. */
typedef struct hearth_pack_instance
{
    uint32_t struct_size;
    uint32_t mesh;
    uint32_t node;                 /* from which it came */
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

/* errors: USAGE, also where there is no such instance. */
HEARTH_API hearth_result hearth_pack_get_instance(const hearth_pack* pack, uint32_t index,
                                                  hearth_pack_instance* instance, char* message,
                                                  size_t message_size);

enum
{
    HEARTH_CAMERA_PERSPECTIVE = 0,
    HEARTH_CAMERA_ORTHOGRAPHIC = 1 /* frames cannot draw it */
};

/* A camera that the artist placed. */
typedef struct hearth_pack_camera
{
    uint32_t struct_size;
    uint32_t type;                 /* HEARTH_CAMERA_* */
    uint32_t node;                 /* from which it came */
    float aspect;                  /* width / height; 0: that of the picture */
    float half_width, half_height; /* metres; of an orthographic camera */
    float z_far;                   /* metres; 0: infinite */
    float world_from_camera[3][4]; /* rows; at rest; looks along -z */
    hearth_camera view;            /* for hearth_frame; y_fov_rad is 0 of an orthographic camera */
} hearth_pack_camera;

#define HEARTH_PACK_CAMERA_INIT                                                                              \
    {                                                                                                        \
        sizeof(hearth_pack_camera), HEARTH_CAMERA_PERSPECTIVE, 0, 0, 0, 0, 0, {{0}},                         \
        {                                                                                                    \
            {0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0, 0                                                           \
        }                                                                                                    \
    }

/* errors: USAGE, also where there is no such camera. */
HEARTH_API hearth_result hearth_pack_get_camera(const hearth_pack* pack, uint32_t index,
                                                hearth_pack_camera* camera, char* message,
                                                size_t message_size);

/* ---- Clips (1.2): played on the CPU, for a frame's moves and poses. ---- */

/* A moment of a clip, which rests before its first and after its last key. */
typedef struct hearth_clip
{
    uint32_t animation; /* of the pack */
    uint32_t reserved;  /* 0 */
    double seconds;     /* finite */
} hearth_clip;

/* Starts at rest. The pack outlives the player. errors: USAGE, OUT_OF_MEMORY. */
HEARTH_API hearth_result hearth_player_create(hearth_pack* pack, hearth_player** player, char* message,
                                              size_t message_size);

/* errors: none. */
HEARTH_API hearth_result hearth_player_destroy(hearth_player* player);

/* Goes to a pose of the whole scene. Allocates nothing.
 * from    NULL: at rest
 * to      a second clip to blend with, or NULL
 * weight  of the second, 0 to 1
 * errors: USAGE. */
HEARTH_API hearth_result hearth_player_go_to(hearth_player* player, const hearth_clip* from,
                                             const hearth_clip* to, double weight, char* message,
                                             size_t message_size);

/* What a frame must be told to show the pose; until the next hearth_player_go_to. */
typedef struct hearth_player_information
{
    uint32_t struct_size;
    uint32_t move_count;
    const hearth_move* moves; /* of rigid instances that stand elsewhere than before the last go_to */
    const hearth_pose* poses; /* of all deformed instances */
    uint32_t pose_count;
    uint32_t reserved; /* 0 */
} hearth_player_information;

#define HEARTH_PLAYER_INFORMATION_INIT                                                                       \
    {                                                                                                        \
        sizeof(hearth_player_information), 0, NULL, NULL, 0, 0                                               \
    }

/* errors: USAGE. */
HEARTH_API hearth_result hearth_player_inform(const hearth_player* player,
                                              hearth_player_information* information);

/* Records culling and drawing, outside a render pass. Clobbers compute and graphics state. Frames of a scene, and frames
 * with the same targets, go to one queue, which draws and computes, in the order in which they were recorded.
 * errors: USAGE, also where the targets belong to another scene. */
HEARTH_API hearth_result hearth_record_frame(hearth_scene* scene, hearth_targets* targets,
                                             VkCommandBuffer commands, const hearth_frame* frame);

/* The parts of a frame (1.1), for callers that put something between them. */
enum
{
    HEARTH_PART_CULL = 0,
    HEARTH_PART_VISIBILITY = 1,
    HEARTH_PART_MATERIALS = 2
};

/* In place of hearth_record_frame: all three in this order, with the same targets and frame, in one command buffer or in
 * several of one queue. They order their own work; hearth_part_inform says how they find and leave the images. In scenes of few
 * materials the parts cost a tile-based GPU more: hearth_record_frame keeps the visibility buffer in the tile. errors: USAGE. */
HEARTH_API hearth_result hearth_record_cull(hearth_scene* scene, hearth_targets* targets,
                                            VkCommandBuffer commands, const hearth_frame* frame);
HEARTH_API hearth_result hearth_record_visibility(hearth_scene* scene, hearth_targets* targets,
                                                  VkCommandBuffer commands, const hearth_frame* frame);
HEARTH_API hearth_result hearth_record_materials(hearth_scene* scene, hearth_targets* targets,
                                                 VkCommandBuffer commands, const hearth_frame* frame);

/* Of an image of the targets; stages 0: the part does not touch it. */
typedef struct hearth_image_use
{
    hearth_image_state before; /* the part waits for such uses; layout UNDEFINED: the content is lost */
    hearth_image_state after;  /* the part leaves it so, visible to these accesses */
} hearth_image_use;

typedef struct hearth_part_information
{
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    hearth_image_use color;
    hearth_image_use visibility;
} hearth_part_information;

#define HEARTH_PART_INFORMATION_INIT                                                                         \
    {                                                                                                        \
        sizeof(hearth_part_information), 0,                                                                  \
            {{VK_IMAGE_LAYOUT_UNDEFINED, 0, 0}, {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0}},                          \
        {                                                                                                    \
            {VK_IMAGE_LAYOUT_UNDEFINED, 0, 0},                                                               \
            {                                                                                                \
                VK_IMAGE_LAYOUT_UNDEFINED, 0, 0                                                              \
            }                                                                                                \
        }                                                                                                    \
    }

/* part  HEARTH_PART_*; the same for all renderers. errors: USAGE. */
HEARTH_API hearth_result hearth_part_inform(uint32_t part, hearth_part_information* information);

/* hearth_record_frame for a scene with a budget, without drawing: asks for what such a frame would want. Moves nothing. Record frames
 * of it until settled_serial reaches the serial of the first of them, and the view is there. errors: USAGE. */
HEARTH_API hearth_result hearth_record_prefetch(hearth_scene* scene, hearth_targets* targets,
                                                VkCommandBuffer commands, const hearth_frame* frame);

/* As it lies in memory. */
typedef struct hearth_frame_counters
{
    uint32_t drawn_clusters;   /* passed all tests */
    uint32_t dropped_clusters; /* of these, the last ones, beyond max_visible_clusters: not drawn */
    uint32_t early_clusters;   /* of these, the first ones, which the last frame's depth did not hide */
    uint32_t reserved;
} hearth_frame_counters;

/* Copies the counters of the frame recorded before it to `offset` (a multiple of 4) of a buffer of the caller (usage
 * TRANSFER_DST), visible to the host once the commands have completed. errors: USAGE. */
HEARTH_API hearth_result hearth_record_counters(hearth_scene* scene, VkCommandBuffer commands,
                                                VkBuffer destination, VkDeviceSize offset);

#endif
