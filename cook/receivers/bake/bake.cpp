// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/bake.h"

#include "cook/receivers/bake/bounces.h"
#include "cook/receivers/bake/dilation.h"
#include "formats/base/assert.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace hearth::receivers
{

namespace
{

/// Lengths of the rays' offset by which points keep off the edges of their triangles.
constexpr float kEdgeOffsets = 4;

/// Texel of the atlas, and the element that has its light.
struct AtlasTexel
{
    BakedTexel texel;
    uint32_t element;
};

std::span<const Triangle> findTriangles(const BakeScene& scene, uint32_t instance)
{
    const auto range = std::ranges::equal_range(scene.triangles, instance, {}, &Triangle::instance);
    return {range.begin(), range.end()};
}

/// Set the size of an instance's rectangle, if its UVs can be used, and return its texels.
TexelDomain rasteriseInstance(const BakeScene& scene, uint32_t instance, const BakeSettings& settings,
                              float margin, InstanceRectangle& rectangle)
{
    const std::span<const Triangle> triangles = findTriangles(scene, instance);
    rectangle.uvs = checkUvs(triangles);
    if (rectangle.uvs.use != UvUse::usable)
        return {};
    const RectangleSize size = chooseRectangle(triangles, settings.texels_per_metre);
    const auto first = static_cast<uint32_t>(triangles.data() - scene.triangles.data());
    TexelDomain domain = rasterise(triangles, first, size.width, size.height, margin);
    rectangle.uvs = checkOverlap(domain);
    if (rectangle.uvs.use != UvUse::usable)
        return {};
    rectangle.size = size;
    return domain;
}

/// Place the rectangles that have a size. False if they do not fit.
bool placeRectangles(BakedReceivers& baked)
{
    std::vector<RectangleSize> sizes;
    for (const InstanceRectangle& rectangle : baked.rectangles)
        if (rectangle.size.width > 0)
            sizes.push_back(rectangle.size);
    const std::optional<AtlasLayout> atlas = layOutAtlas(sizes);
    if (!atlas)
        return false;
    baked.width = atlas->width;
    baked.height = atlas->height;
    auto place = atlas->places.begin();
    for (InstanceRectangle& rectangle : baked.rectangles)
        if (rectangle.size.width > 0)
            rectangle.place = *place++;
    return true;
}

/// Append the texels of an instance that have light, and copies of them.
/// first_element  of the instance
void addTexels(const BakeScene& scene, const TexelDomain& domain, const InstanceRectangle& rectangle,
               const GatherTable& table, uint32_t instance, uint32_t first_element,
               std::vector<AtlasTexel>& texels)
{
    const size_t first = texels.size();
    std::vector<TexelCell> cells;
    const auto add = [&](AtlasTexel texel, TexelCell cell)
    {
        texel.texel.x = static_cast<uint16_t>(static_cast<int32_t>(rectangle.place.x) + cell.x);
        texel.texel.y = static_cast<uint16_t>(static_cast<int32_t>(rectangle.place.y) + cell.y);
        texels.push_back(texel);
    };
    for (uint32_t i = 0; i < domain.texels.size(); ++i)
    {
        if (table.openPoints(first_element + i) == 0)
            continue;
        const DomainTexel& texel = domain.texels[i];
        Element middle;
        middle.points.fill(texel.middle);
        const ReceivingPoint point = receivingPoint(scene, middle, 0, 0);
        cells.push_back({texel.x, texel.y});
        add({{0, 0, false, instance, point.position, point.normal}, first_element + i}, cells.back());
    }
    for (const TexelCopy& copy : dilate(domain.width, domain.height, cells))
    {
        AtlasTexel texel = texels[first + copy.source];
        texel.texel.is_copy = true;
        add(texel, copy.cell);
    }
}

} // namespace

std::optional<BakedReceivers> bakeReceivers(const BakeScene& scene, const BakeSettings& settings)
{
    HEARTH_ASSERT(std::ranges::is_sorted(scene.triangles, {}, &Triangle::instance));
    const BakeRays rays = makeBakeRays(scene);
    BakedReceivers baked;
    baked.light_count = scene.lightCount();
    baked.rectangles.resize(scene.instance_count);
    std::vector<TexelDomain> domains(scene.instance_count);
    tbb::parallel_for(uint32_t{0}, scene.instance_count,
                      [&](uint32_t i) {
                          domains[i] = rasteriseInstance(scene, i, settings, kEdgeOffsets * rays.offset,
                                                         baked.rectangles[i]);
                      });
    if (!placeRectangles(baked))
        return std::nullopt;
    const Elements elements(scene, domains, settings.patch_size);
    const GatherTable table(scene, rays, elements);
    const BounceTiles tiles(scene, domains, elements, table);
    baked.gather_rays = elements.list().size() * kElementRays;

    std::vector<AtlasTexel> texels;
    uint32_t first_element = 0;
    for (uint32_t i = 0; i < scene.instance_count; ++i)
    {
        addTexels(scene, domains[i], baked.rectangles[i], table, i, first_element, texels);
        first_element += static_cast<uint32_t>(domains[i].texels.size());
    }
    std::ranges::sort(texels, {}, [](const AtlasTexel& at) { return std::pair(at.texel.y, at.texel.x); });
    for (const AtlasTexel& at : texels)
        baked.texels.push_back(at.texel);

    baked.irradiance.resize(texels.size() * baked.light_count);
    for (size_t first = 0; first < baked.light_count; first += kLightGroup)
    {
        const size_t count = std::min(kLightGroup, baked.light_count - first);
        const GroupLight light =
            computeLight(scene, rays, elements, domains, table, tiles, first, count, settings.bounces);
        baked.shadow_rays += light.shadow_rays;
        for (size_t i = 0; i < texels.size(); ++i)
            for (size_t k = 0; k < count; ++k)
            {
                const float* value = &light.irradiance[(texels[i].element * count + k) * 3];
                baked.irradiance[i * baked.light_count + first + k] = {value[0], value[1], value[2]};
            }
    }
    return baked;
}

} // namespace hearth::receivers
