// How the meshes of an import part move over all poses of its scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/mesh_motion.h"
#include "cook/mesh/source_mesh.h"
#include "formats/pack/pack_view.h"

#include <memory>

namespace hearth::clusters
{

/// The motion of one mesh, as long as the PartMotion lives.
struct OwnedMotion
{
    std::unique_ptr<motion::SkinMotion> skin;
    MeshMotion motion;
};

/// Bounds of all nodes of a part. Any number of threads may ask at once.
class PartMotion
{
public:
    /// errors: those of PackView::read.
    static Result<PartMotion> read(const formats::ContainerReader& part);

    /// The motion of mesh `index`, which is `mesh`: of the nodes that have it. errors: meaning_reference where it names
    /// joints that its skin has not.
    Result<OwnedMotion> of(uint32_t index, const mesh::SourceMesh& mesh) const;

private:
    explicit PartMotion(formats::PackView view);

    std::shared_ptr<const formats::PackView> view_;
    formats::MotionTables tables_;
    std::vector<motion::NodeMotion> nodes_;
};

} // namespace hearth::clusters
