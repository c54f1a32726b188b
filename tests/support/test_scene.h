// A pack in memory, put together in a test: meshes through the real cluster builder, the rest by hand.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "cook/mesh/source_mesh.h"
#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/lod_curve.h"
#include "tests/support/small_pack.h"

#include <functional>
#include <random>

namespace hearth::test
{

/// glTF's defaults with a white dielectric: no texture, roughness 1.
formats::MaterialRecord plainMaterial();

/// A texture on UV set 0, repeated.
formats::TextureRef textureOf(uint32_t image);

class TestScene
{
public:
    uint32_t addMaterial(const formats::MaterialRecord& material);
    /// Four bytes a texel; the mips one after the other, as many as there are texels for.
    uint32_t addImage(formats::TexelFormat format, uint32_t width, uint32_t height,
                      const std::vector<uint32_t>& texels);
    /// Cooks the mesh; returns its number.
    uint32_t addMesh(const mesh::SourceMesh& mesh, const clusters::Config& config = {});
    uint32_t addHierarchy(const clusters::Hierarchy& hierarchy);
    /// Sets the flags and scale_max that the importer would.
    void addInstance(uint32_t mesh, const Affine3& world_from_object);
    void addLight(const formats::LightRecord& light);
    /// What the vertices of all levels see of the sky, where they say it: after all meshes. In object space.
    using Visibility =
        std::function<shared::VisibilityMoments(uint32_t mesh, Float3 position, Float3 normal)>;
    void setVisibility(const Visibility& visibility);

    /// The pack, which has passed the checker. The scene must outlive it and not change.
    formats::PackView build();

    /// The same, where something is still missing that the checker would miss.
    formats::PackView assemble();

    PackModel& model() { return model_; }

private:
    uint32_t addNode(uint32_t mesh, const Affine3& parent_from_node);

    PackModel model_;
    AlignedBytes bytes_;
};

/// A rectangle of two triangles around the origin that faces +z, UVs from (0, 0) at its top left to (1, 1).
mesh::SourceMesh makeQuad(float width, float height);

/// Set the material of all triangles.
mesh::SourceMesh withMaterial(mesh::SourceMesh mesh, uint32_t material);

Affine3 translated(Float3 offset);

/// Rotation, scales of 0.3 to 3 that differ, shear, a mirror half of the time, and a translation within `reach`.
Affine3 randomAffine(std::mt19937& random, float reach);

/// Eye and target about the origin, field of view and near plane at random.
shared::Camera randomCamera(std::mt19937& random, float reach);

/// A valid distance curve, as steep as may be, upwards and downwards.
std::vector<shared::LodKnot> randomLodCurve(std::mt19937& random);

/// Uniform in [low, high), the same on every machine.
float uniform(std::mt19937& random, float low, float high);

} // namespace hearth::test
