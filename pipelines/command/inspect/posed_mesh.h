// A mesh of a pack as a clip has it at one time: its vertices in the scene's space.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"

#include <optional>
#include <string>

namespace hearth::command
{

/// A clip by its name, or one without a name by its index; seconds from its start.
struct ClipTime
{
    std::string animation;
    double time_s = 0;
};

struct PosedVertex
{
    Float3 position; ///< scene's space
    Float3 normal;   ///< of length 1, if the mesh has normals
    Float3
        m1; ///< of its visibility, if the mesh has one: turned with the normal and the surface, as long as before
    bool mirrored = false; ///< triangles at it turn the other way
};

/// How the first instance of a mesh is posed; where it has none, as its first node would be.
class PosedMesh
{
public:
    /// clip  nothing: the rest pose
    /// errors: usage where the pack has no such clip
    static Result<PosedMesh> make(const formats::PackView& pack, uint32_t mesh,
                                  const std::optional<ClipTime>& clip);

    /// The cluster is one of the mesh.
    PosedVertex vertex(const formats::ClusterGeometry& geometry, uint32_t vertex) const;

    /// For each joint of the skin, scene from bind pose; one for a mesh without a skin.
    std::span<const Affine3d> palette() const { return palette_; }

private:
    Affine3d worldFromVertex(const formats::ClusterGeometry& geometry, uint32_t vertex) const;

    std::vector<Affine3d> palette_;     ///< for each joint of the skin; one for a mesh without
    std::vector<double> morph_weights_; ///< of the node; missing ones are 0
};

/// Whether joints or morph targets can move the vertices of the mesh.
bool isDeformed(const formats::MeshRecord& mesh);

} // namespace hearth::command
