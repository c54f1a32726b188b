// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_bricks.h"

#include "formats/gpu_shared/brick_lighting.h"
#include "runtime/gpu/scene/scene.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace hearth::gpu
{

namespace
{

constexpr VkBufferUsageFlags kTableUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

/// Create a buffer of at least one word.
Result<Buffer> createTable(const Device& device, const formats::PackView& pack, uint64_t bytes,
                           VkBufferUsageFlags more_usage, Scene& scene)
{
    if (bytes > device.limits.maxStorageBufferRange)
        return Error{Issue::device_limit, pack.name(), "",
                     "the bricks take " + std::to_string(bytes) + " bytes, the device binds " +
                         std::to_string(device.limits.maxStorageBufferRange)};
    return scene.arena.createBuffer(std::max<uint64_t>(bytes, 4), kTableUsage | more_usage,
                                    MemoryKind::device);
}

/// Albedo, emission and normals of all faces, in three consecutive arrays.
std::vector<std::byte> readSurfaces(const formats::PackView& pack)
{
    const std::span<const std::byte> parts[] = {std::as_bytes(pack.brickAlbedo()),
                                                std::as_bytes(pack.brickEmission()),
                                                std::as_bytes(pack.brickNormals())};
    std::vector<std::byte> bytes;
    for (const std::span<const std::byte> part : parts)
        bytes.insert(bytes.end(), part.begin(), part.end());
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return bytes;
}

std::vector<shared::BrickLocation> readPlaces(const formats::PackView& pack)
{
    const formats::BrickGridRecord& grid = pack.brickGrid()[0];
    const uint32_t groups_x = shared::brickGroupsAlongAxis(grid.voxels[0]),
                   groups_y = shared::brickGroupsAlongAxis(grid.voxels[1]);
    std::vector<shared::BrickLocation> places;
    for (uint32_t number = 0; number < pack.brickGroupsAlongAxis().size(); ++number)
    {
        const formats::BrickGroupRecord& group = pack.brickGroupsAlongAxis()[number];
        const uint32_t x = number % groups_x * shared::kGroupVoxels,
                       y = number / groups_x % groups_y * shared::kGroupVoxels,
                       z = number / (groups_x * groups_y) * shared::kGroupVoxels;
        for (uint32_t bit = 0; bit < 64; ++bit)
            if (shared::maskHas(group.brick_mask_low, group.brick_mask_high, bit))
                places.push_back(
                    {.xy = (x + (bit & 3) * 4) | (y + (bit >> 2 & 3) * 4) << 16, .z = z + (bit >> 4) * 4});
    }
    return places;
}

std::vector<uint32_t> readFirstFaces(const formats::PackView& pack)
{
    std::vector<uint32_t> first_faces;
    for (const formats::BrickRecord& brick : pack.bricks())
        first_faces.push_back(brick.first_face);
    first_faces.push_back(static_cast<uint32_t>(pack.brickAlbedo().size()));
    return first_faces;
}

/// Stored light of faces without that of baked lamps: of the sun that a pack without lights has.
std::vector<uint32_t> readDefaultSun(const formats::PackView& pack)
{
    std::vector<Float3> light;
    for (const uint32_t code : pack.brickLighting())
        light.push_back(shared::decodeRadiance(code));
    const formats::ReceiverTables tables = pack.faceReceivers();
    for (const formats::ReceiverBlockRecord& block : tables.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
            for (uint32_t color = 1; color <= block.color_count; ++color)
            {
                const uint32_t* const word = &tables.words[block.first_word + i];
                Float3& face = light[shared::receiverFace(*word)];
                face =
                    face - shared::decodeReceiverColor(word[color * block.texel_count], tables.atlas.codec) *
                               tables.atlas.scale;
            }
    std::vector<uint32_t> codes;
    for (const Float3& face : light)
        codes.push_back(shared::encodeRadiance(face)); // negative differences of roundings become 0
    return codes;
}

/// Initial light as stored in the pack, encoded without loss. Where lamps are baked into faces there is none
/// but that of the default sun, and behind it room for theirs, which the first update brings.
std::vector<uint32_t> readLight(const formats::PackView& pack)
{
    const bool has_lamps = !pack.faceAtlases().empty();
    if (has_lamps && !pack.lights().empty())
        return std::vector<uint32_t>(pack.brickLighting().size() * 3);
    const std::vector<uint32_t> sun = has_lamps ? readDefaultSun(pack) : std::vector<uint32_t>{};
    std::vector<uint32_t> light;
    for (const uint32_t code : has_lamps ? std::span<const uint32_t>(sun) : pack.brickLighting())
        light.insert(light.end(), {code, 0});
    light.resize(pack.brickLighting().size() * (has_lamps ? 3 : 2));
    return light;
}

/// Frames that light all faces once: at most one per brick.
uint32_t findPeriod(const formats::PackView& pack, const BrickOptions& options)
{
    return std::clamp(pack.brickGrid()[0].face_count / std::max(1u, options.faces_per_frame), 1u,
                      std::max(1u, static_cast<uint32_t>(pack.bricks().size())));
}

uint32_t maxFacesPerFrame(const SceneBricks& bricks)
{
    uint32_t most = 0;
    for (uint32_t frame = 0; frame < bricks.period; ++frame)
        most = std::max(most, nextBrickShare(bricks, frame).face_count);
    return most;
}

Status createBuffers(const Device& device, const formats::PackView& pack, Uploader& uploader, Scene& scene)
{
    SceneBricks& b = *scene.bricks;
    const auto upload = [&](Buffer& target, std::span<const std::byte> bytes,
                            VkBufferUsageFlags more_usage = 0) -> Status
    {
        HEARTH_ASSIGN_OR_RETURN(target, createTable(device, pack, bytes.size(), more_usage, scene));
        return uploader.upload(target, bytes);
    };
    std::vector<std::byte> opacity(pack.brickOpacity().size_bytes());
    std::memcpy(opacity.data(), pack.brickOpacity().data(), opacity.size());
    opacity.resize((opacity.size() + 3) / 4 * 4);
    HEARTH_TRY(upload(b.groups, std::as_bytes(pack.brickGroupsAlongAxis())));
    HEARTH_TRY(upload(b.bricks, std::as_bytes(pack.bricks())));
    const std::vector<shared::BrickLocation> places = readPlaces(pack);
    const std::vector<uint32_t> light = readLight(pack);
    HEARTH_TRY(upload(b.places, std::as_bytes(std::span(places))));
    HEARTH_TRY(upload(b.opacity, opacity));
    HEARTH_TRY(upload(b.surfaces, readSurfaces(pack)));
    HEARTH_TRY(upload(b.lighting, std::as_bytes(std::span(light)), VK_BUFFER_USAGE_TRANSFER_SRC_BIT));
    HEARTH_ASSIGN_OR_RETURN(
        b.fresh, createTable(device, pack, sizeof(shared::BrickLight) * maxFacesPerFrame(b), 0, scene));
    return success();
}

} // namespace

BrickShare nextBrickShare(const SceneBricks& bricks, uint32_t frame)
{
    const auto brick_count = static_cast<uint32_t>(bricks.first_faces.size() - 1);
    const uint32_t first = shared::brickSliceBegin(brick_count, frame, bricks.period);
    const uint32_t end = shared::brickSliceEnd(brick_count, frame, bricks.period);
    return {first, end - first, bricks.first_faces[first],
            bricks.first_faces[end] - bricks.first_faces[first]};
}

uint64_t maxFreshLightWords(const formats::PackView& pack, const BrickOptions& options)
{
    if (pack.brickGrid().empty())
        return 0;
    SceneBricks bricks;
    bricks.first_faces = readFirstFaces(pack);
    bricks.period = findPeriod(pack, options);
    return uint64_t{maxFacesPerFrame(bricks)} * (sizeof(shared::BrickLight) / sizeof(uint32_t));
}

Status uploadBricks(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                    const BrickOptions& options, Uploader& uploader, Scene& scene)
{
    if (pack.brickGrid().empty())
        return success();
    scene.bricks = std::make_unique<SceneBricks>();
    SceneBricks& b = *scene.bricks;
    b.grid = pack.brickGrid()[0];
    b.rays = options.rays;
    b.first_faces = readFirstFaces(pack);
    b.period = findPeriod(pack, options);
    HEARTH_TRY(createBuffers(device, pack, uploader, scene));

    for (uint32_t number = 0; number < scene.frames.size(); ++number)
    {
        SceneFrame& frame = scene.frames[number];
        HEARTH_ASSIGN_OR_RETURN(frame.brick_set, allocateSet(device, scene.pool.get(), layouts.bricks.get()));
        DescriptorWriter(frame.brick_set)
            .uniform(shared::kBricksFrame, frame.main.frame)
            .uniform(shared::kBricksView, frame.brick_view)
            .storage(shared::kBricksGroups, b.groups)
            .storage(shared::kBricksBricks, b.bricks)
            .storage(shared::kBricksOpacity, b.opacity)
            .storage(shared::kBricksSurfaces, b.surfaces)
            .storage(shared::kBricksLight, b.lighting)
            .storage(shared::kBricksLighting, scene.tables->lighting.copy(number))
            .write(device);
    }
    HEARTH_ASSIGN_OR_RETURN(b.fresh_set, allocateSet(device, scene.pool.get(), layouts.fresh_light.get()));
    DescriptorWriter(b.fresh_set)
        .storage(shared::kFreshLightFaces, b.fresh)
        .storage(shared::kFreshLightLocations, b.places)
        .write(device);
    return success();
}

} // namespace hearth::gpu
