// All geometry pages of a pack, decoded at once, and the triangles of clusters as plain lists.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <array>
#include <compare>
#include <vector>

namespace hearth::reference
{

/// A cluster of an instance, as culling puts it on the visible list.
struct DrawnCluster
{
    uint32_t instance = 0;
    uint32_t cluster = 0;
    friend auto operator<=>(const DrawnCluster&, const DrawnCluster&) = default;
};

/// A triangle of an instance, in the object space of its mesh.
struct SceneTriangle
{
    std::array<Float3, 3> corners;
    uint32_t instance = 0;
    uint32_t material = 0; ///< or kInvalidIndex
    uint32_t id = 0;
};

/// What drawing needs of a scene besides triangles.
struct SceneTables
{
    std::span<const formats::InstanceRecord> instances;
    std::span<const formats::MaterialRecord> materials;
};

SceneTables tablesOf(const formats::PackView& view);

/// Whether a material's back faces are drawn; the default material's are not.
bool isDoubleSided(std::span<const formats::MaterialRecord> materials, uint32_t material);

/// Whether an instance's mesh has joints or morph targets, so that its bounds are those of all its poses.
bool isDeformed(const formats::PackView& view, uint32_t instance);

/// Decoded pages; the view must outlive it.
class PackGeometry
{
public:
    static Result<PackGeometry> decode(const formats::PackView& view);

    const formats::PackView& view() const { return *view_; }
    formats::ClusterGeometry cluster(uint32_t index) const;

    /// The corners of a cluster's triangles, in order.
    std::vector<std::array<Float3, 3>> triangles(uint32_t cluster) const;

private:
    explicit PackGeometry(const formats::PackView& view) : view_(&view) {}

    const formats::PackView* view_;
    std::vector<std::vector<std::byte>> pages_;
};

/// The triangles that a visible list draws; id = slot << 7 | triangle, as in the visibility buffer.
std::vector<SceneTriangle> trianglesOfSlots(const PackGeometry& geometry,
                                            std::span<const DrawnCluster> slots);

/// Level 0 of every instance; id = running number.
std::vector<SceneTriangle> trianglesOfFinestLevel(const PackGeometry& geometry);

} // namespace hearth::reference
