// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/elements.h"

#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <unordered_map>

namespace hearth::receivers
{

namespace
{

/// Points of the unit square, one in each quarter, for trianglePoint.
constexpr std::array<Float2, kTexelPoints> kQuarters{Float2{0.375f, 0.125f}, Float2{0.875f, 0.375f},
                                                     Float2{0.125f, 0.625f}, Float2{0.625f, 0.875f}};

float longestEdge(const Triangle& triangle)
{
    float longest = 0;
    for (size_t i = 0; i < 3; ++i)
        longest = std::max(longest, length(triangle.corners[(i + 1) % 3] - triangle.corners[i]));
    return longest;
}

/// Return the number of a patch of a triangle whose edges have `divisions` parts, row by row of corner 2's
/// weight. Each row begins and ends with a patch that points the same way as the triangle.
uint32_t patchAt(Float2 weights, uint32_t divisions)
{
    const float u = std::clamp(weights.x, 0.0f, 1.0f) * static_cast<float>(divisions);
    const float v = std::clamp(weights.y, 0.0f, 1.0f) * static_cast<float>(divisions);
    const uint32_t row = std::min(static_cast<uint32_t>(v), divisions - 1);
    const uint32_t column = std::min(static_cast<uint32_t>(u), divisions - 1 - row);
    const float rest = (u - static_cast<float>(column)) + (v - static_cast<float>(row));
    const bool is_upper = rest > 1 && column + row + 1 < divisions;
    return row * (2 * divisions - row) + 2 * column + (is_upper ? 1u : 0u);
}

/// Return the points of a patch, whose lowest corner is column, row.
Element makePatch(uint32_t triangle, bool is_back, uint32_t divisions, uint32_t column, uint32_t row,
                  bool is_upper)
{
    Element element{{}, is_back};
    const float step = 1 / static_cast<float>(divisions);
    for (size_t i = 0; i < kTexelPoints; ++i)
    {
        const Float2 in = sampling::trianglePoint(kQuarters[i]);
        const Float2 at = is_upper ? Float2{1 - in.x, 1 - in.y} : in;
        element.points[i] = {
            triangle, {(static_cast<float>(column) + at.x) * step, (static_cast<float>(row) + at.y) * step}};
    }
    return element;
}

} // namespace

/// Patches that small triangles share.
class Elements::SharedPatches
{
public:
    explicit SharedPatches(float size) : size_(size) {}

    /// Return the patch of a triangle's side, a new one if it is the first there.
    uint32_t add(Elements& elements, uint32_t number, bool is_back)
    {
        const Triangle& triangle = elements.scene_.triangles[number];
        const Float3 across = crossEdges(triangle) * (is_back ? -1.0f : 1.0f);
        const float area = length(across);
        const Element element = makePatch(number, is_back, 1, 0, 0, false);
        const auto [found, is_new] =
            patches_.try_emplace(key(triangle, across), static_cast<uint32_t>(elements.elements_.size()));
        const uint32_t patch = found->second;
        if (is_new)
        {
            elements.addElement(element);
            members_[patch] = {0, 0};
        }
        Member& member = members_[patch];
        // a reservoir: any four of the triangles, in all of the cube
        const size_t slot = member.count < kTexelPoints
                                ? member.count
                                : sampling::deriveSeed(patch, member.count) % (member.count + 1);
        if (slot < kTexelPoints)
            elements.elements_[patch].points[slot] = {number, {1.0f / 3, 1.0f / 3}};
        ++member.count;
        member.area += area;
        const float share = member.area > 0 ? area / member.area : 1;
        Float3& albedo = elements.albedos_[patch];
        albedo += (triangle.albedo - albedo) * share;
        return patch;
    }

private:
    struct Member
    {
        size_t count;
        float area;
    };

    /// Cube and direction of a triangle. Two cubes with one key would only share a light.
    uint64_t key(const Triangle& triangle, Float3 across) const
    {
        const Float3 middle = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / (3 * size_);
        uint64_t result = 0;
        for (int axis = 0; axis < 3; ++axis)
            result = result << 20 |
                     (static_cast<uint64_t>(static_cast<int64_t>(std::floor(middle[axis]))) & 0xFFFFF);
        int axis = 0;
        for (int other = 1; other < 3; ++other)
            axis = std::abs(across[other]) > std::abs(across[axis]) ? other : axis;
        return result << 3 | static_cast<uint64_t>(2 * axis + (across[axis] < 0 ? 1 : 0));
    }

    float size_;
    std::unordered_map<uint64_t, uint32_t> patches_;
    std::unordered_map<uint32_t, Member> members_;
};

Elements::Elements(const BakeScene& scene, std::span<const TexelDomain> domains, float patch_size)
    : scene_(scene)
{
    HEARTH_ASSERT(patch_size > 0 && domains.size() == scene.instance_count);
    for (const TexelDomain& domain : domains)
        addTexels(domain);
    texel_count_ = elements_.size();
    for (std::vector<PatchRange>& ranges : patches_)
        ranges.resize(scene.triangles.size());
    SharedPatches shared(patch_size);
    for (uint32_t t = 0; t < scene.triangles.size(); ++t)
    {
        if (grids_[scene.triangles[t].instance].elements.empty())
            addPatches(t, false, patch_size, shared);
        if (scene.triangles[t].double_sided)
            addPatches(t, true, patch_size, shared);
    }
}

void Elements::addElement(const Element& element)
{
    Float3 albedo;
    for (const SurfacePoint& point : element.points)
        albedo += scene_.triangles[point.triangle].albedo / kTexelPoints;
    elements_.push_back(element);
    albedos_.push_back(albedo);
}

void Elements::addTexels(const TexelDomain& domain)
{
    Grid grid;
    if (!domain.texels.empty())
        grid = {domain.width, domain.height,
                std::vector<uint32_t>(size_t{domain.width} * domain.height, kInvalidIndex)};
    for (const DomainTexel& texel : domain.texels)
    {
        grid.elements[size_t{texel.y} * domain.width + texel.x] = static_cast<uint32_t>(elements_.size());
        addElement({texel.points, false});
    }
    grids_.push_back(std::move(grid));
}

void Elements::addPatches(uint32_t triangle, bool is_back, float patch_size, SharedPatches& shared)
{
    PatchRange& range = patches_[is_back ? 1 : 0][triangle];
    const float longest = longestEdge(scene_.triangles[triangle]);
    if (longest <= patch_size)
    {
        range.first = shared.add(*this, triangle, is_back);
        return;
    }
    const float wanted = std::min(std::ceil(longest / patch_size), float{kMaxDivisions});
    const auto divisions = static_cast<uint32_t>(wanted);
    range = {static_cast<uint32_t>(elements_.size()), divisions};
    for (uint32_t row = 0; row < divisions; ++row)
        for (uint32_t column = 0; column + row < divisions; ++column)
        {
            addElement(makePatch(triangle, is_back, divisions, column, row, false));
            if (column + row + 1 < divisions)
                addElement(makePatch(triangle, is_back, divisions, column, row, true));
        }
}

uint32_t Elements::find(SurfacePoint point, bool is_front) const
{
    const Grid& grid = grids_[scene_.triangles[point.triangle].instance];
    if (is_front && !grid.elements.empty())
        return findTexel(grid, point);
    const PatchRange& range = patches_[is_front ? 0 : 1][point.triangle];
    if (range.first == kInvalidIndex || range.divisions == 1)
        return range.first;
    return range.first + patchAt(point.weights, range.divisions);
}

uint32_t Elements::findTexel(const Grid& grid, SurfacePoint point) const
{
    const Float2 uv = interpolate(scene_.triangles[point.triangle].uvs, point.weights);
    const auto texel = [](float at, uint32_t count)
    {
        return std::min(static_cast<uint32_t>(std::clamp(at, 0.0f, 1.0f) * static_cast<float>(count)),
                        count - 1);
    };
    const uint32_t x = texel(uv.x, grid.width), y = texel(uv.y, grid.height);
    const uint32_t element = grid.elements[size_t{y} * grid.width + x];
    if (element != kInvalidIndex)
        return element;
    // a point at the rim of a chart rounds to the texel beside it
    for (uint32_t near_y = y - std::min(y, 1u); near_y < std::min(y + 2, grid.height); ++near_y)
        for (uint32_t near_x = x - std::min(x, 1u); near_x < std::min(x + 2, grid.width); ++near_x)
            if (const uint32_t near = grid.elements[size_t{near_y} * grid.width + near_x];
                near != kInvalidIndex)
                return near;
    return kInvalidIndex;
}

} // namespace hearth::receivers
