// Poses a mesh of a pack by a clip at one time: its vertices in scene space.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"

#include <optional>
#include <string>

namespace hearth::command
{

/// Time of a clip. The clip is given by its name, or by its index if it has no name; time in seconds from its
/// start.
struct ClipTime
{
    std::string animation;
    double time_s = 0;
};

struct PosedVertex
{
    Float3 position; ///< scene space
    Float3 normal;   ///< unit length, if the mesh has normals
    /// First moment of the visibility, if the mesh has it: turned with normal and surface, length unchanged.
    Float3 m1;
    bool mirrored = false; ///< its triangles have the opposite winding
};

/// Pose of the first instance of a mesh; of its first node if it has no instance.
class PosedMesh
{
public:
    /// Compute the pose.
    /// clip  nullopt: the rest pose
    /// errors: usage if the pack has no such clip
    static Result<PosedMesh> make(const formats::PackView& pack, uint32_t mesh,
                                  const std::optional<ClipTime>& clip);

    /// Pose a vertex of a cluster, which must be one of the mesh.
    PosedVertex vertex(const formats::ClusterGeometry& geometry, uint32_t vertex) const;

    /// Scene-from-bind-pose transforms of the skin's joints; one transform for a mesh without a skin.
    std::span<const Affine3d> palette() const { return palette_; }

private:
    Affine3d worldFromVertex(const formats::ClusterGeometry& geometry, uint32_t vertex) const;

    std::vector<Affine3d> palette_;     ///< see palette()
    std::vector<double> morph_weights_; ///< of the node; missing ones are 0
};

} // namespace hearth::command
