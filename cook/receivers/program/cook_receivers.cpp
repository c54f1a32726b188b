// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/program/cook_receivers.h"

#include "cook/receivers/scene/receiver_scene.h"
#include "cook/tools/source_name.h"
#include "formats/base/index.h"

#include <map>
#include <optional>

namespace hearth::receivers
{

using namespace formats;

namespace
{

/// First record of each source in the tables of the pack, where the records of all sources follow each other.
struct PackOffsets
{
    std::vector<uint32_t> instances;

    explicit PackOffsets(const bricks::StaticScene& scene)
    {
        uint32_t next = 0;
        for (const bricks::SourceParts& source : scene.sources)
        {
            instances.push_back(next);
            next += static_cast<uint32_t>(source.scene.instances().size());
        }
    }

    /// Return the instance of the pack for one of the static scene.
    uint32_t findInstance(const bricks::StaticScene& scene, uint32_t number) const
    {
        const bricks::StaticInstance& instance = scene.instances[number];
        return instances[instance.source] + instance.record;
    }
};

/// Lamps of the atlas, and the baked lights that each of them sums.
struct LampTable
{
    std::vector<ReceiverLampRecord> records;
    std::vector<std::vector<size_t>> lights;

    void add(ReceiverLampKind kind, uint32_t index, std::vector<size_t> baked)
    {
        records.push_back({static_cast<uint32_t>(kind), index});
        lights.push_back(std::move(baked));
    }
};

LampTable makeLampTable(const bricks::StaticScene& scene, const ReceiverScene& receivers,
                        const PackOffsets& offsets)
{
    LampTable lamps;
    const size_t first_mesh_light = receivers.bake.lamps.size();
    std::vector<size_t> steady{receivers.bake.lightCount() - 1};
    if (receivers.has_default_sun)
        steady.push_back(0);
    lamps.add(ReceiverLampKind::steady, 0, std::move(steady));
    if (!receivers.has_default_sun)
        for (uint32_t i = 0; i < first_mesh_light; ++i)
            lamps.add(ReceiverLampKind::light, i, {i});
    for (size_t i = 0; i < receivers.mesh_light_instances.size(); ++i)
        lamps.add(ReceiverLampKind::mesh_light,
                  offsets.findInstance(scene, receivers.mesh_light_instances[i]), {first_mesh_light + i});
    return lamps;
}

std::vector<ReceiverRectRecord> makeRects(const bricks::StaticScene& scene, const ReceiverScene& receivers,
                                          const PackOffsets& offsets, const BakedReceivers& baked)
{
    std::vector<ReceiverRectRecord> rects;
    for (uint32_t i = 0; i < baked.rectangles.size(); ++i)
        if (const InstanceRectangle& rectangle = baked.rectangles[i]; rectangle.size.width > 0)
            rects.push_back({offsets.findInstance(scene, i), rectangle.place.x, rectangle.place.y,
                             rectangle.size.width, rectangle.size.height, receivers.uv_sets[i]});
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
Status checkSizes(const BakedReceivers& baked, size_t lamps, const SelectOptions& options)
{
    if (lamps > kMaxReceiverLamps)
        return makeTooLarge(std::to_string(lamps) + " lamps; an atlas has " +
                            std::to_string(kMaxReceiverLamps) + " at most");
    const uint64_t colors = std::min<uint64_t>(lamps, options.max_colors);
    if (baked.texels.size() * (1 + colors) >= kMaxTableBytes / sizeof(uint32_t))
        return makeTooLarge(std::to_string(baked.texels.size()) +
                            " texels; lower receivers.texels_per_metre");
    return success();
}

} // namespace

Result<CookedReceivers> cookReceivers(const bricks::StaticScene& scene, const shared::SceneProbes& probes,
                                      const CookSettings& settings)
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
    if (baked->width == 0)
        return cooked;
    const PackOffsets offsets(scene);
    const LampTable lamps = makeLampTable(scene, receivers, offsets);
    HEARTH_TRY(checkSizes(*baked, lamps.records.size(), settings.atlas.select));
    cooked.atlas = makeAtlas(lamps, makeRects(scene, receivers, offsets, *baked), *baked, settings.atlas);
    return cooked;
}

} // namespace hearth::receivers
