// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/program/cook_receivers.h"

#include "cook/receivers/scene/face_light.h"
#include "cook/tools/source_name.h"
#include "formats/base/index.h"

#include <map>
#include <optional>

namespace hearth::receivers
{

using namespace formats;

namespace
{

std::vector<ReceiverRectRecord> makeRects(const ReceiverScene& receivers,
                                          std::span<const uint32_t> pack_instances,
                                          const BakedReceivers& baked)
{
    std::vector<ReceiverRectRecord> rects;
    for (uint32_t i = 0; i < baked.rectangles.size(); ++i)
        if (const InstanceRectangle& rectangle = baked.rectangles[i]; rectangle.size.width > 0)
            rects.push_back({pack_instances[i], rectangle.place.x, rectangle.place.y, rectangle.size.width,
                             rectangle.size.height, receivers.uv_sets[i]});
    return rects;
}

/// Pack the light of the texels that were baked.
Atlas makeAtlas(const LampTable& lamps, std::span<const ReceiverRectRecord> rects,
                const BakedReceivers& baked, const AtlasOptions& options)
{
    const size_t cells = size_t{baked.width} * baked.height, count = lamps.records.size();
    std::vector<uint8_t> valid(cells);
    std::vector<Float3> light(cells * count);
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        const size_t cell = size_t{baked.texels[i].y} * baked.width + baked.texels[i].x;
        valid[cell] = 1;
        for (size_t lamp = 0; lamp < count; ++lamp)
            for (const size_t source : lamps.lights[lamp])
                light[cell * count + lamp] += baked.light(i)[source];
    }
    return packAtlas({baked.width, baked.height, lamps.records, rects, valid, light}, options);
}

void countUnusable(const UvCheck& check, bool has_triangles, bool has_uvs, InstancesWithoutUvs& counts)
{
    if (!has_triangles)
        ++counts.transparent;
    else if (!has_uvs)
        ++counts.none;
    else if (check.use == UvUse::flat)
        ++counts.flat;
    else if (check.use == UvUse::outside)
        ++counts.outside;
    else
        ++counts.overlapping;
}

/// Set what says which instances have no receivers, and why.
void listUnusable(const bricks::StaticScene& scene, const ReceiverScene& receivers,
                  const BakedReceivers& baked, CookedReceivers& cooked)
{
    std::vector<bool> has_triangles(scene.instances.size());
    for (const Triangle& triangle : receivers.bake.triangles)
        has_triangles[triangle.instance] = true;
    std::map<std::pair<uint32_t, uint32_t>, UnusableMesh> meshes;
    for (uint32_t i = 0; i < scene.instances.size(); ++i)
    {
        const InstanceRectangle& rectangle = baked.rectangles[i];
        if (rectangle.size.width > 0)
            continue;
        const bool has_uvs = receivers.uv_sets[i] != kInvalidIndex;
        countUnusable(rectangle.uvs, has_triangles[i], has_uvs, cooked.without_uvs);
        if (!has_triangles[i])
            continue;
        const uint32_t source = scene.instances[i].source, mesh = scene.instances[i].mesh;
        const bricks::SourceParts& parts = scene.sources[source];
        meshes.try_emplace({source, mesh},
                           UnusableMesh{tools::readSourceName(parts.scene),
                                        std::string(parts.clusters.text(parts.clusters.meshes()[mesh].name)),
                                        has_uvs ? describe(rectangle.uvs) : "it has no UVs"});
    }
    for (auto& [key, mesh] : meshes)
        cooked.unusable_meshes.push_back(std::move(mesh));
}

Error makeTooLarge(std::string detail)
{
    return {Issue::input_too_large, "receivers", "", std::move(detail)};
}

/// Check that the tables of an atlas do not grow past their limits, whatever lamps its texels keep.
/// remedy  against too many texels
Status checkSizes(uint64_t texels, size_t lamps, const SelectOptions& options, const char* remedy)
{
    if (lamps > kMaxReceiverLamps)
        return makeTooLarge(std::to_string(lamps) + " lamps; receivers have " +
                            std::to_string(kMaxReceiverLamps) + " at most");
    const uint64_t colors = std::min<uint64_t>(lamps, options.max_colors);
    if (texels * (1 + colors) >= kMaxTableBytes / sizeof(uint32_t))
        return makeTooLarge(std::to_string(texels) + remedy);
    return success();
}

} // namespace

Result<CookedReceivers> cookReceivers(const bricks::StaticScene& scene, const shared::SceneProbes& probes,
                                      const PackView* bricks, const CookSettings& settings)
{
    HEARTH_ASSIGN_OR_RETURN(const ReceiverScene receivers, makeReceiverScene(scene, probes));
    const std::optional<BakedReceivers> baked = bakeReceivers(receivers.bake, settings.bake);
    if (!baked)
        return makeTooLarge("the atlas needs more than " + std::to_string(kMaxAtlasSide) +
                            " texels each way; lower receivers.texels_per_metre");
    CookedReceivers cooked;
    cooked.left_out = scene.left_out;
    cooked.shadow_rays = baked->shadow_rays;
    cooked.gather_rays = baked->gather_rays;
    listUnusable(scene, receivers, *baked, cooked);
    const std::vector<uint32_t> pack_instances = findPackInstances(scene);
    const LampTable lamps = makeLampTable(receivers, pack_instances);
    const SelectOptions& select = settings.atlas.select;
    if (baked->width > 0)
    {
        HEARTH_TRY(checkSizes(baked->texels.size(), lamps.records.size(), select,
                              " texels; lower receivers.texels_per_metre"));
        cooked.atlas = makeAtlas(lamps, makeRects(receivers, pack_instances, *baked), *baked, settings.atlas);
    }
    if (bricks != nullptr && bricks->brickGrid()[0].face_count > 0)
    {
        const uint32_t faces = bricks->brickGrid()[0].face_count;
        HEARTH_TRY(checkSizes(faces, lamps.records.size(), select, " faces of bricks; lower bricks.memory"));
        HEARTH_ASSIGN_OR_RETURN(const std::vector<Float3> light,
                                bakeFaces(scene, *bricks, probes, receivers, lamps));
        cooked.faces = packFaces(lamps.records, light, faces, settings.atlas);
    }
    return cooked;
}

} // namespace hearth::receivers
