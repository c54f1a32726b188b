// Builds a pack in memory for a test: meshes through the real cluster builder, everything else by hand.
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

/// glTF's default material with a white dielectric: no texture, roughness 1.
formats::MaterialRecord plainMaterial();

/// Texture on UV set 0, with repeat wrapping.
formats::TextureRef makeTextureRef(uint32_t image);

class TestScene
{
public:
    uint32_t addMaterial(const formats::MaterialRecord& material);
    /// Add an image. A word a texel, or two where the format has 16 bits a channel; the mips one after the
    /// other, as many as there are texels for.
    uint32_t addImage(formats::TexelFormat format, uint32_t width, uint32_t height,
                      const std::vector<uint32_t>& texels);
    /// Add an image of any format, with its mips as packs store them.
    uint32_t addImage(const formats::ImageRecord& image, const std::vector<std::byte>& mips);
    /// Cook the mesh; return its index.
    uint32_t addMesh(const mesh::SourceMesh& mesh, const clusters::Config& config = {});
    uint32_t addHierarchy(const clusters::Hierarchy& hierarchy);
    /// Set the flags and scale_max as the importer does.
    void addInstance(uint32_t mesh, const Affine3& world_from_object);
    void addLight(const formats::LightRecord& light);
    /// Set the sky visibility of the vertices of all levels that have it. Call it after all meshes are added.
    /// In object space.
    using Visibility =
        std::function<shared::VisibilityMoments(uint32_t mesh, Float3 position, Float3 normal)>;
    void setVisibility(const Visibility& visibility);

    /// Return the pack, checked. The scene must outlive it and not change.
    formats::PackView build();

    /// Return the pack without the check, for scenes that are still incomplete.
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

/// Random rotation, non-uniform scales of 0.3 to 3, shear, a mirror half of the time, and a translation
/// within `reach`.
Affine3 randomAffine(std::mt19937& random, float reach);

/// Camera with eye and target about the origin, and random field of view and near plane.
shared::Camera randomCamera(std::mt19937& random, float reach);
/// The same with parallel rays.
shared::Camera randomOrthographicCamera(std::mt19937& random, float reach);

/// Valid distance curve, as steep as allowed, upwards and downwards.
std::vector<shared::LodKnot> randomLodCurve(std::mt19937& random);

/// Uniform in [low, high), the same on every machine.
float uniform(std::mt19937& random, float low, float high);

} // namespace hearth::test
