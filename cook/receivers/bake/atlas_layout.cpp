// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/atlas_layout.h"

#include <algorithm>
#include <cmath>

// a stable sort, so that equal rectangles have the same places everywhere
#define STBRP_SORT(items, count, size, compare)                                                              \
    std::stable_sort(items, (items) + (count),                                                               \
                     [](const stbrp_rect& a, const stbrp_rect& b) { return compare(&a, &b) < 0; })
#define STBRP_ASSERT(condition) HEARTH_ASSERT(condition)
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include "formats/base/assert.h"

#include <stb/stb_rect_pack.h>

namespace hearth::receivers
{

namespace
{

/// Widths to try, over the side of a square with the area of all rectangles.
constexpr std::array kWidthFactors{1.0, 1.05, 1.12, 1.25, 1.5, 2.0};

/// Pack into an image of a width, as high as needed. nullopt: does not fit.
std::optional<AtlasLayout> packInto(std::vector<stbrp_rect> rectangles, uint32_t width)
{
    std::vector<stbrp_node> nodes(width);
    stbrp_context context;
    stbrp_init_target(&context, static_cast<int>(width), static_cast<int>(kMaxAtlasSide), nodes.data(),
                      static_cast<int>(nodes.size()));
    if (stbrp_pack_rects(&context, rectangles.data(), static_cast<int>(rectangles.size())) == 0)
        return std::nullopt;
    AtlasLayout atlas;
    for (const stbrp_rect& rectangle : rectangles)
    {
        atlas.width = std::max(atlas.width, static_cast<uint32_t>(rectangle.x + rectangle.w));
        atlas.height = std::max(atlas.height, static_cast<uint32_t>(rectangle.y + rectangle.h));
        atlas.places.push_back({static_cast<uint32_t>(rectangle.x) + kAtlasBorder,
                                static_cast<uint32_t>(rectangle.y) + kAtlasBorder});
    }
    return atlas;
}

} // namespace

std::optional<AtlasLayout> layOutAtlas(std::span<const RectangleSize> rectangles)
{
    std::vector<stbrp_rect> bordered;
    double area = 0;
    uint32_t max_width = 0;
    for (const RectangleSize& rectangle : rectangles)
    {
        const uint32_t width = rectangle.width + 2 * kAtlasBorder,
                       height = rectangle.height + 2 * kAtlasBorder;
        bordered.push_back({static_cast<int>(bordered.size()), static_cast<stbrp_coord>(width),
                            static_cast<stbrp_coord>(height), 0, 0, 0});
        area += double{1} * width * height;
        max_width = std::max(max_width, width);
    }
    if (bordered.empty())
        return AtlasLayout{};
    std::optional<AtlasLayout> best;
    for (const double factor : kWidthFactors)
    {
        const double wanted = std::max(std::ceil(std::sqrt(area) * factor), static_cast<double>(max_width));
        const auto width = static_cast<uint32_t>(std::min(wanted, double{kMaxAtlasSide}));
        std::optional<AtlasLayout> atlas = packInto(bordered, width);
        const auto texels = [](const AtlasLayout& packed) { return uint64_t{packed.width} * packed.height; };
        if (atlas && (!best || texels(*atlas) < texels(*best)))
            best = std::move(atlas);
    }
    return best;
}

} // namespace hearth::receivers
