// The frame as data: its passes in order, and what each of them loads, reads, writes and stores. This table
// makes the render passes, the barriers between passes and the image states that callers get; the lint
// (frame_lint.h) checks it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/post.h"
#include "runtime/gpu/frame/color_format.h"
#include "runtime/gpu/lights/light_method.h"
#include "runtime/gpu/vulkan/device_table.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::gpu
{

/// Images and buffers that pass from one step of a frame to another.
enum class FrameResource : uint8_t
{
    visibility, ///< visible triangle of each pixel; attachment
    depth,      ///< attachment
    color,      ///< the shaded frame; attachment
    surfaces,   ///< what lights behind shading need of the surface of a pixel; attachment
    // what lights ahead of shading need of it; attachments
    normals,         ///< LightPath::light_sums
    joint_normals,   ///< LightPath::joint_sums
    encoded_normals, ///< LightPath::encoded_joint_sums
    diffuse_light,   ///< sums of these paths; attachments
    specular_light,
    grazing_light,  ///< specular light that has Schlick's term
    low_light_bits, ///< of LightPath::light_bits: 32 lights each; attachments
    high_light_bits,
    pyramid,        ///< depth pyramid of occlusion culling
    gathered_light, ///< indirect light of tiles of 8 x 8 pixels, as shading reads it
    gather_points,  ///< buffers of the same tiles
    tile_lists,     ///< buffers: tiles of 64 x 64 pixels of each material
    shadow_map,     ///< a layer; its texels are not the frame's pixels
    scene_tables,   ///< groups of a streamed scene
    pages,          ///< geometry that is streamed in, to where no frame in flight reads
    work_lists,     ///< results of culling, of one view after another
    visible_list,   ///< clusters to draw, their draws, counters and skinned vertices
    caster_lists,   ///< the same of shadow maps
    brick_light,    ///< light of the faces of bricks
    light_lists,    ///< lights of the frame, and of its cells, tiles or slots
    radiance,       ///< linear colours of the frame, before a final pass; attachment
    bloom_level_1,  ///< attachment of half the frame's side; each of the next four is half the one before
    bloom_level_2,
    bloom_level_3,
    bloom_level_4,
    bloom_level_5,
    bloom_sum_1, ///< sum of that level and the coarser ones; attachment
    bloom_sum_2,
    bloom_sum_3,
    bloom_sum_4,
    exposure,      ///< stops of automatic exposure; attachment of one pixel
    last_exposure, ///< of the last frame: both change their places from frame to frame
    count,
};

/// Return a level of bloom.
/// level  1 to shared::kBloomLevels
constexpr FrameResource bloomLevel(uint32_t level)
{
    static_assert(shared::kBloomLevels == static_cast<uint32_t>(FrameResource::bloom_sum_1) -
                                              static_cast<uint32_t>(FrameResource::bloom_level_1));
    return static_cast<FrameResource>(static_cast<uint32_t>(FrameResource::bloom_level_1) + level - 1);
}

/// Return the sum of a level of bloom and the coarser ones; of the last one, the level itself.
constexpr FrameResource bloomSum(uint32_t level)
{
    return level == shared::kBloomLevels
               ? bloomLevel(level)
               : static_cast<FrameResource>(static_cast<uint32_t>(FrameResource::bloom_sum_1) + level - 1);
}

/// Attachments that a frame need not take off the tile.
inline constexpr FrameResource kTileAttachments[] = {
    FrameResource::visibility,      FrameResource::depth,          FrameResource::color,
    FrameResource::surfaces,        FrameResource::normals,        FrameResource::joint_normals,
    FrameResource::encoded_normals, FrameResource::diffuse_light,  FrameResource::specular_light,
    FrameResource::grazing_light,   FrameResource::low_light_bits, FrameResource::high_light_bits,
    FrameResource::radiance};

/// Return the image that FrameStep::normals draws.
/// path  one that sums lights
constexpr FrameResource normalsImage(LightPath path)
{
    return path == LightPath::light_sums   ? FrameResource::normals
           : path == LightPath::joint_sums ? FrameResource::joint_normals
                                           : FrameResource::encoded_normals;
}

/// True if an image has linear colours: FrameConfiguration::radiance_format.
constexpr bool isLinear(FrameResource resource)
{
    return resource >= FrameResource::radiance && resource <= FrameResource::bloom_sum_4;
}

/// Unit of a resource's size.
enum class ResourceKind : uint8_t
{
    attachment, ///< image of the frame's size that is drawn to
    image,      ///< image, or buffer used as one, that compute passes write
    buffer,
    shadow_map, ///< image of another size
};

struct ResourceFacts
{
    const char* name;
    ResourceKind kind;
    /// The frame's; a texel's of a shadow map with 32-bit depths. 0: does not follow the image.
    float bytes_per_pixel;
    /// Each frame in flight writes a part of its own, and waits for no earlier frame.
    bool has_parts = false;
};
const ResourceFacts& resourceFacts(FrameResource resource);

/// Work of a frame that is recorded in one piece, in recording order.
enum class FrameStep : uint8_t
{
    update,
    light_lists, ///< find the lights of the frame, and of each cell
    brick_light,
    shadow_cull,       ///< find the casters of as many maps as are culled side by side
    shadow_map,        ///< draw a map
    shadow_copy,       ///< begin a map as a copy of its casters at rest
    moving_shadow_map, ///< draw the casters that move on top
    cull,
    last_pyramid, ///< of the last frame's depth, for the next frame
    early_visibility,
    early_pyramid, ///< of the early phase
    late_cull,
    slot_lights, ///< find the lights of each slot of the visible list
    visibility,
    pyramid,        ///< for the next frame
    visible_lights, ///< find the lights of tiles or cells, by what pixels show
    material_tiles,
    gather,
    normals, ///< store what lights need of surfaces, ahead of shading
    /// Add light to surfaces that are stored: behind shading, or to sums between normals and shading.
    add_lights,
    mark_lights, ///< mark the lights that reach a pixel, ahead of shading
    shading,
    exposure,   ///< automatic exposure, by the last frame's light
    bloom_down, ///< a level of bloom
    bloom_up,   ///< a sum of levels
    final_pass,
    count,
};
const char* stepName(FrameStep step);

/// Use of a resource by a step.
enum class Access : uint8_t
{
    color_write,
    depth_write, ///< tested and written
    depth_keep,  ///< bound, neither tested nor written: a tiler merges subpasses only if they share the depth
    input,       ///< input attachment: the pixel's own value
    depth_input, ///< the same of a depth that is tested as well, beside a stencil that is written
    sampled,     ///< by a compute shader
    compute_read,  ///< as storage
    compute_write, ///< as storage
    vertex_read,   ///< by indirect draws and vertex shaders
    fragment_read, ///< sampled or as storage
    copy_read,
    copy_write,
};
VkPipelineStageFlags accessStages(Access access);
VkAccessFlags accessFlags(Access access);
bool isWrite(Access access);
/// Layout in which an image has to be for an access; UNDEFINED for buffers.
VkImageLayout accessLayout(Access access);

/// Fate of the content that a resource has before an access.
enum class Content : uint8_t
{
    begin,     ///< cleared first
    overwrite, ///< every pixel is written
    keep,      ///< read, or added to
};

struct ResourceUse
{
    FrameResource resource;
    Access access;
    Content content = Content::keep;
    float share = 1; ///< texels read or written, of all
};

enum class LoadOperation : uint8_t
{
    none, ///< content undefined
    clear,
    load,
};

/// An attachment of a render pass.
struct AttachmentUse
{
    FrameResource resource;
    LoadOperation load = LoadOperation::none;
    bool store = false;
    const char* reader = nullptr; ///< step that needs what is stored, kCaller or kNextFrame; null: not stored
    VkImageLayout initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout final_layout = VK_IMAGE_LAYOUT_UNDEFINED;
};
inline constexpr const char* kCaller = "the caller";
inline constexpr const char* kNextFrame = "the next frame";

/// Geometry that covers the frame where a step draws no clusters.
enum class Cover : uint8_t
{
    none,
    triangle, ///< one, larger than the frame
    tiles,    ///< quads of 64 x 64 pixels, or one triangle
    quad,     ///< two triangles with a common diagonal
};

/// Facts of a step's draws that a tile-based GPU punishes.
struct DrawFacts
{
    Cover cover = Cover::none;
    bool clears_by_command = false;
    bool discards = false;              ///< opaque geometry
    bool writes_fragment_depth = false; ///< opaque geometry
};

struct Subpass
{
    FrameStep step;
    bool is_empty = false; ///< there so that render passes are compatible; nothing is drawn
    std::vector<ResourceUse> attachments{};
    DrawFacts draws{};
};

enum class PassKind : uint8_t
{
    compute,
    render,
    transfer,
};

/// Way in which the CPU hands over what a pass uploads.
enum class HostWrite : uint8_t
{
    none,
    ring,     ///< a part of a mapped buffer that no frame in flight reads
    in_place, ///< mapped memory that an earlier frame may still read
};

/// Memory dependency on everything earlier that touched what a pass touches.
struct PassBarrier
{
    VkPipelineStageFlags from = 0;
    VkAccessFlags written = 0;
    VkPipelineStageFlags to = 0;
    VkAccessFlags accessed = 0;
};

/// Change of an image's layout after a pass.
struct LayoutChange
{
    FrameResource resource;
    VkImageLayout from = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImageLayout to = VK_IMAGE_LAYOUT_UNDEFINED;
};

struct Pass
{
    PassKind kind = PassKind::compute;
    std::vector<FrameStep> steps{};           ///< one, or one for each subpass that draws
    std::vector<AttachmentUse> attachments{}; ///< render passes only
    std::vector<Subpass> subpasses{};         ///< render passes only
    std::vector<ResourceUse> uses{};          ///< all but attachments
    HostWrite host_write = HostWrite::none;
    bool by_region = true; ///< dependencies between subpasses are between pixels
    PassBarrier barrier{}; ///< before compute shaders, copies and vertices of the pass
    /// Before the fragments and attachments of a render pass, whose vertices need not wait for as much.
    PassBarrier fragment_barrier{};
    /// Right behind a pass whose lists draws read: their vertices wait for no pass that lies between.
    PassBarrier vertex_barrier{};
    /// Number of the shadow map that the pass draws, or begins, in a layer of its own.
    std::optional<uint32_t> map{};
    VkFormat map_format = VK_FORMAT_UNDEFINED;      ///< of that map
    VkFormat radiance_format = VK_FORMAT_UNDEFINED; ///< as FrameConfiguration
    VkFormat color_format = kColorFormat;           ///< as FrameConfiguration
    /// Images that the pass reads and the caller gets after it, visible to transfers.
    std::vector<LayoutChange> handed_out{};
};

/// Return the name of a pass: its steps, joined by " + ".
std::string passName(const Pass& pass);

/// Return the name of the step of a pass that uses an image.
const char* userName(const Pass& pass, FrameResource resource);

/// True if the pass has a size of its own: the frame's sum of bytes leaves it out.
inline bool hasOwnSize(const Pass& pass)
{
    return pass.map.has_value();
}

/// Shadow map that a frame draws.
enum class MapContent : uint8_t
{
    fresh,
    moving, ///< begins as a copy of a map without the casters that move
};

/// Occlusion culling of a frame.
enum class OcclusionCulling : uint8_t
{
    off,
    /// Against an earlier frame's depth: objects that come into view may be missing for a frame, or for two
    /// where nothing lies between visibility and shading (FrameStep::last_pyramid).
    last_frame,
    two_phase, ///< lossless
};

/// Way through a frame: its render passes. The image is the same.
enum class FrameWay : uint8_t
{
    /// Render passes of two subpasses: shading reads the pixel's own value of the visibility buffer, which
    /// need not leave the tile.
    merged,
    /// A render pass for each step that draws: shading samples the visibility buffer. For drivers that fail
    /// at subpasses or do not merge them.
    separate,
    /// The render passes of `merged`, in which all that shading binds is one descriptor set. For drivers that
    /// fail at input attachments beside other sets.
    one_set,
};
inline constexpr FrameWay kFrameWays[] = {FrameWay::merged, FrameWay::separate, FrameWay::one_set};

/// True if shading reads the visibility buffer as an input attachment, in a subpass of its own.
constexpr bool hasSubpasses(FrameWay way)
{
    return way != FrameWay::separate;
}

/// Way in which shading finds the pixels of a material.
enum class MaterialTest : uint8_t
{
    depth, ///< material numbers overwrite the depth, and the depth test compares them
    id,    ///< the shader compares numbers, and the depth stays; a stencil of their low bits rejects early
};

/// Format of linear colours, and of bloom: 4 bytes a pixel. Devices that cannot draw to it, and callers that
/// need more than 6 bits of fraction, have R16G16B16A16_SFLOAT.
inline constexpr VkFormat kPackedRadiance = VK_FORMAT_B10G11R11_UFLOAT_PACK32;

/// Everything that decides which passes a frame has.
struct FrameConfiguration
{
    FrameWay way = FrameWay::merged;
    OcclusionCulling occlusion = OcclusionCulling::two_phase;
    MaterialTest materials = MaterialTest::depth;
    bool material_tiles = false;
    bool gathers_light = false;
    bool in_parts = false;         ///< the caller may put work between visibility and shading
    bool keeps_visibility = false; ///< the caller reads the visibility buffer after the frame
    /// The caller uses the depth after the frame, and gives it back as it got it. With MaterialTest::id.
    bool keeps_depth = false;
    bool shows_overdraw = false;
    bool has_shadows = false;
    VkFormat shadow_format = VK_FORMAT_D32_SFLOAT; ///< of shadow maps, or VK_FORMAT_D16_UNORM
    bool lists_lights = false;                     ///< the device lists lights; otherwise the CPU has done so
    bool lists_slots = false;                      ///< in slot_lights, those of slots
    bool lists_visible = false; ///< in visible_lights, those of tiles or cells by what pixels show
    bool lights_bricks = false;
    std::vector<MapContent> maps{}; ///< shadow maps that the frame draws, in order; the others are cached
    uint32_t maps_at_once = 8;      ///< maps whose casters are found before any of them is drawn
    /// Shading writes linear colours, and a pass of its own finishes them. The next two need it.
    bool has_final_pass = false;
    bool adapts_exposure = false; ///< automatic exposure
    bool blooms = false;
    VkFormat radiance_format = kPackedRadiance;
    VkFormat color_format = kColorFormat; ///< one of colorFormats()
    /// Place of lights. Others than materials have MaterialTest::id, and those that store surfaces a final
    /// pass; on the tile there is neither bloom nor automatic exposure.
    LightPath light_path = LightPath::materials;
};

struct FrameDescription
{
    FrameConfiguration configuration;
    std::vector<Pass> passes;
    /// Attachments that never leave the tile: their memory need not exist.
    std::vector<FrameResource> transient;
};

} // namespace hearth::gpu
