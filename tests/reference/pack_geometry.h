// Decodes all geometry pages of a pack at once, and lists the triangles of clusters.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <array>
#include <compare>
#include <vector>

namespace hearth::reference
{

/// A cluster of an instance, as in the visible list of the culling pass.
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

/// Tables of a scene that drawing needs besides triangles.
struct SceneTables
{
    std::span<const formats::InstanceRecord> instances;
    std::span<const formats::MaterialRecord> materials;
};

SceneTables readTables(const formats::PackView& view);

/// True if back faces of the material are drawn; those of the default material are not.
bool isDoubleSided(std::span<const formats::MaterialRecord> materials, uint32_t material);

/// True if the instance's mesh has joints or morph targets, so that its bounds cover all its poses.
bool isDeformed(const formats::PackView& view, uint32_t instance);

/// Decoded pages; the view must outlive it.
class PackGeometry
{
public:
    static Result<PackGeometry> decode(const formats::PackView& view);

    const formats::PackView& view() const { return *view_; }
    formats::ClusterGeometry cluster(uint32_t index) const;

    /// Corners of a cluster's triangles, in order.
    std::vector<std::array<Float3, 3>> triangles(uint32_t cluster) const;

private:
    explicit PackGeometry(const formats::PackView& view) : view_(&view) {}

    const formats::PackView* view_;
    std::vector<std::vector<std::byte>> pages_;
};

/// Triangles that a visible list draws; id = slot << 7 | triangle, as in the visibility buffer.
std::vector<SceneTriangle> trianglesOfSlots(const PackGeometry& geometry,
                                            std::span<const DrawnCluster> slots);

/// Triangles of level 0 of every instance; id = running number.
std::vector<SceneTriangle> trianglesOfFinestLevel(const PackGeometry& geometry);

} // namespace hearth::reference
