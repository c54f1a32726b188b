// Motion of the meshes of an import part over all poses of its scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/mesh_motion.h"
#include "cook/mesh/source_mesh.h"
#include "formats/pack/pack_view.h"

#include <memory>

namespace hearth::clusters
{

/// Motion of one mesh; valid as long as the PartMotion lives.
struct OwnedMotion
{
    std::unique_ptr<animation_bounds::SkinMotion> skin;
    MeshMotion motion;
};

/// Motion bounds of all nodes of a part. Thread-safe for reading.
class PartMotion
{
public:
    /// errors: those of PackView::read.
    static Result<PartMotion> read(const formats::ContainerReader& part);

    /// Return the motion of mesh `index`, which is `mesh`, over the nodes that use it. errors:
    /// meaning_reference if it refers to joints that its skin has not.
    Result<OwnedMotion> meshMotion(uint32_t index, const mesh::SourceMesh& mesh) const;

private:
    explicit PartMotion(formats::PackView view);

    std::shared_ptr<const formats::PackView> view_;
    formats::AnimationTables tables_;
    std::vector<animation_bounds::NodeMotion> nodes_;
};

} // namespace hearth::clusters
