// Divides all surfaces of a scene into elements, each with one light: texels where an instance has them,
// patches elsewhere.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/bake_scene.h"
#include "cook/receivers/bake/texel_domain.h"
#include "formats/base/index.h"

#include <vector>

namespace hearth::receivers
{

/// Piece of a surface, sampled at some points.
struct Element
{
    std::array<SurfacePoint, kTexelPoints> points;
    bool is_back = false; ///< the back of its triangles
};

/// Elements of a scene. Texels come first, by instance and in the order of their domains.
class Elements
{
public:
    /// domains     one for each instance; without texels where it has none
    /// patch_size  metres, above 0: longest edge of a patch, unless a triangle would have more than
    ///             kMaxDivisions along an edge. Smaller triangles share a patch within a cube of this
    ///             size, if they face the same way.
    Elements(const BakeScene& scene, std::span<const TexelDomain> domains, float patch_size);

    static constexpr uint32_t kMaxDivisions = 64;

    /// Return the element at a point of a triangle's front or back.
    /// returns  kInvalidIndex: none, the surface is black
    uint32_t find(SurfacePoint point, bool is_front) const;

    std::span<const Element> list() const { return elements_; }
    /// Return the mean albedo of each element's triangles.
    std::span<const Float3> albedos() const { return albedos_; }
    size_t texelCount() const { return texel_count_; }

private:
    /// Texels of an instance.
    struct Grid
    {
        uint32_t width = 0, height = 0;
        std::vector<uint32_t> elements; ///< of each texel, or kInvalidIndex
    };
    /// Patches of one side of a triangle.
    struct PatchRange
    {
        uint32_t first = kInvalidIndex;
        uint32_t divisions = 1; ///< of each edge; the side has as many patches as its square
    };
    class SharedPatches;

    void addTexels(const TexelDomain& domain);
    void addPatches(uint32_t triangle, bool is_back, float patch_size, SharedPatches& shared);
    uint32_t findTexel(const Grid& grid, SurfacePoint point) const;
    void addElement(const Element& element);

    const BakeScene& scene_;
    std::vector<Element> elements_;
    std::vector<Float3> albedos_;
    size_t texel_count_ = 0;
    std::vector<Grid> grids_;                        ///< of instances
    std::array<std::vector<PatchRange>, 2> patches_; ///< of fronts and backs, by triangle
};

} // namespace hearth::receivers
