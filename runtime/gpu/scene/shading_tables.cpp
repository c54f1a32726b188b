// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/local_probes.h"
#include "formats/scene/reflectance.h"
#include "formats/scene/sheen.h"
#include "formats/scene/sky_image.h"
#include "formats/scene/sky_table.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/vulkan/sampler.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

constexpr uint32_t kNodes = shared::kSpecularNodes;

constexpr VkImageUsageFlags kTableUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

/// Copy a table into the image of all tables.
void copyTable(std::span<const uint64_t> table, uint32_t columns, uint32_t column, uint32_t row,
               std::vector<uint64_t>& texels)
{
    for (size_t from = 0; from < table.size(); from += columns)
        std::copy_n(table.begin() + static_cast<std::ptrdiff_t>(from), columns,
                    texels.begin() + static_cast<std::ptrdiff_t>(
                                         (row + from / columns) * shared::kShadingTablesWidth + column));
}

/// Return the texels of shared::kSceneShadingTables, four halves each.
std::vector<uint64_t> makeShadingTables()
{
    static_assert(shared::kSheenTableColumn >= shared::kReflectanceColumns &&
                  shared::kSheenTableColumn + shared::kReflectanceColumns <= shared::kShadingTablesWidth);
    static_assert(shared::kSkyTableRow >= shared::kReflectanceRows &&
                  shared::kSkyTableRow + shared::kSkyTableAngles <= shared::kShadingTablesHeight &&
                  shared::kSkyTableHeights <= shared::kShadingTablesWidth);
    std::vector<uint64_t> texels(size_t{shared::kShadingTablesWidth} * shared::kShadingTablesHeight);
    copyTable(shared::kReflectanceTable, shared::kReflectanceColumns, 0, 0, texels);
    copyTable(shared::kSheenTable, shared::kReflectanceColumns, shared::kSheenTableColumn, 0, texels);
    const std::vector<uint64_t> sky(shared::skyTable().begin(), shared::skyTable().end());
    copyTable(sky, shared::kSkyTableHeights, 0, shared::kSkyTableRow, texels);
    return texels;
}

/// Upload the pack's table of specular occlusion, if it has one, and its binding has room for it.
Status uploadSpecularTable(const Device& device, const formats::PackView& pack, VkSampler sampler,
                           Uploader& uploader, Scene& scene)
{
    if (pack.specularTables().empty() || scene.probe_atlas.view.get() != VK_NULL_HANDLE)
        return success();
    const formats::SpecularTableRecord& table = pack.specularTables()[0];
    // same layout as in the file: the squares of the nodes of beta, one below the other
    HEARTH_ASSIGN_OR_RETURN(
        scene.specular_table,
        scene.arena.createImage(
            {.format = VK_FORMAT_R8_UNORM, .extent = {kNodes, kNodes * kNodes}, .usage = kTableUsage}));
    HEARTH_TRY(uploader.upload(scene.specular_table, std::as_bytes(std::span(table.values)), {.bytes = 1}));
    scene.specular_spacing = table.spacing;
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .texture(shared::kSceneSpecularTable, scene.specular_table.view.get(), sampler)
                        .write(device);
                });
    return success();
}

/// Upload the cube map of the sky's probe; a black one if the pack has none, since the binding must be valid.
Status uploadSkyCube(const Device& device, const formats::PackView& pack, Uploader& uploader, Scene& scene)
{
    uint32_t side = 1, mip_count = 1;
    const std::array<uint32_t, 6> black{};
    std::span<const uint32_t> texels = black;
    if (const std::optional<size_t> sky = shared::findSkyProbe(pack.probes()))
    {
        const formats::ProbeRecord& probe = pack.probes()[*sky];
        side = formats::finestProbeSide(probe);
        mip_count = formats::countProbeMips(probe);
        texels = pack.probeTexels().subspan(probe.texels.first, probe.texels.count);
    }
    HEARTH_ASSIGN_OR_RETURN(scene.sky_cube,
                            scene.arena.createImage({.format = VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
                                                     .extent = {side, side},
                                                     .mip_count = mip_count,
                                                     .usage = kTableUsage,
                                                     .is_cube = true}));
    HEARTH_TRY(uploader.upload(scene.sky_cube, std::as_bytes(texels), {.bytes = sizeof(uint32_t)}));
    HEARTH_ASSIGN_OR_RETURN(UniqueSampler sampler, createCubeSampler(device));
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .texture(shared::kSceneSkyCube, scene.sky_cube.view.get(), sampler.get())
                        .write(device);
                });
    scene.samplers.push_back(std::move(sampler));
    return success();
}

/// Upload the atlas of the local probes, if the pack has any.
Status uploadProbeAtlas(const Device& device, const formats::PackView& pack, VkSampler sampler,
                        Uploader& uploader, Scene& scene)
{
    const shared::ProbeAtlas atlas = shared::makeProbeAtlas(pack.probes(), pack.probeTexels());
    if (atlas.texels.empty())
        return success();
    HEARTH_ASSIGN_OR_RETURN(scene.probe_atlas,
                            scene.arena.createImage({.format = VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
                                                     .extent = {atlas.width, atlas.height},
                                                     .usage = kTableUsage}));
    HEARTH_TRY(uploader.upload(scene.probe_atlas, std::as_bytes(std::span(atlas.texels)),
                               {.bytes = sizeof(uint32_t)}));
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .texture(shared::kSceneSpecularTable, scene.probe_atlas.view.get(), sampler)
                        .write(device);
                });
    return success();
}

} // namespace

Status uploadShadingTables(const Device& device, const formats::PackView& pack, Uploader& uploader,
                           Scene& scene)
{
    // clamps to the last node of an axis
    HEARTH_ASSIGN_OR_RETURN(UniqueSampler linear, createClampingSampler(device, VK_FILTER_LINEAR));
    const VkSampler sampler = linear.get();
    scene.samplers.push_back(std::move(linear));
    HEARTH_ASSIGN_OR_RETURN(
        scene.shading_tables,
        scene.arena.createImage({.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                 .extent = {shared::kShadingTablesWidth, shared::kShadingTablesHeight},
                                 .usage = kTableUsage}));
    const std::vector<uint64_t> tables = makeShadingTables();
    HEARTH_TRY(
        uploader.upload(scene.shading_tables, std::as_bytes(std::span(tables)), {.bytes = sizeof(uint64_t)}));
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .texture(shared::kSceneShadingTables, scene.shading_tables.view.get(), sampler)
                        .write(device);
                });
    HEARTH_TRY(uploadSkyCube(device, pack, uploader, scene));
    HEARTH_TRY(uploadProbeAtlas(device, pack, sampler, uploader, scene));
    return uploadSpecularTable(device, pack, sampler, uploader, scene);
}

} // namespace hearth::gpu
