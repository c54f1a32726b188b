// Builds a pack with deformed meshes: limbs with joints and morph targets, in random poses. Their bounds are
// computed from these poses alone and hold for no others.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"
#include "runtime/gpu/scene/deformation_layout.h"
#include "tests/reference/pack_geometry.h"
#include "tests/support/test_scene.h"

#include <optional>
#include <random>
#include <vector>

namespace hearth::test
{

/// A palette and morph weights, as gpu::InstancePose.
struct TestPose
{
    uint32_t instance = 0;
    std::vector<Affine3d> world_from_bind;
    std::vector<float> morph_weights;
    bool free = false;

    gpu::InstancePose view() const
    {
        return {.instance = instance,
                .world_from_bind = world_from_bind,
                .morph_weights = morph_weights,
                .free = free};
    }
};

std::vector<gpu::InstancePose> makeViews(const std::vector<TestPose>& poses);

/// A vertex in a pose as specified by glTF, in doubles: world space.
struct PosedVertex
{
    Double3 position;
    Double3 normal;  ///< unit
    Double3 tangent; ///< of any length
};
PosedVertex posedVertex(const formats::ClusterGeometry& geometry, uint32_t vertex, const TestPose& pose);

struct DeformedSceneOptions
{
    uint32_t limbs =
        5; ///< instances, at least one, as of the next two: of a limb of 6 joints, each third one mirrored
    uint32_t tentacles = 2;             ///< instances with eight influences and three morph targets
    uint32_t blobs = 2;                 ///< instances with morph targets only
    uint32_t rocks = 4;                 ///< rigid instances
    uint32_t pose_count = 8;            ///< of each deformed mesh
    uint32_t rings = 40;                ///< rings of triangles in a limb
    float reach = 3;                    ///< metres from the origin
    TestScene::Visibility visibility{}; ///< of deformed meshes; none: without visibility
};

class DeformedScene
{
public:
    DeformedScene(const DeformedSceneOptions& options, uint32_t seed);

    const formats::PackView& pack() const { return *pack_; }
    /// The pack as a file; valid until the next call.
    const AlignedBytes& bytes()
    {
        bytes_ = test_.model().bytes();
        return bytes_;
    }
    const reference::PackGeometry& geometry() const { return *geometry_; }
    const std::vector<uint32_t>& deformedInstances() const { return deformed_; }

    /// One of the poses that the bounds hold for, at a random place.
    TestPose randomPose(uint32_t instance, std::mt19937& random) const;
    /// A pose that the bounds do not hold for.
    TestPose freePose(uint32_t instance, std::mt19937& random) const;
    /// Random poses for some of the instances.
    std::vector<TestPose> randomPoses(std::mt19937& random) const;

private:
    struct Mesh
    {
        uint32_t mesh;
        uint32_t skin;
        std::vector<TestPose> poses; ///< the first is the bind pose
    };
    uint32_t addSkin(uint32_t joint_count);
    void addDeformed(uint32_t mesh, uint32_t skin, uint32_t joint_count, uint32_t pose_count,
                     std::mt19937& random);
    void addInstances(const Mesh& mesh, uint32_t count, std::mt19937& random);
    void boundMesh(const Mesh& mesh);
    void boundGroups(const Mesh& mesh, std::span<const Box3> boxes);
    const Mesh& getMesh(uint32_t instance) const;
    Affine3d choosePlace(uint32_t instance, std::mt19937& random) const;

    DeformedSceneOptions options_;
    TestScene test_;
    std::vector<Mesh> meshes_;
    std::vector<uint32_t> deformed_;
    std::optional<formats::PackView> pack_;
    std::optional<reference::PackGeometry> geometry_;
    AlignedBytes bytes_;
};

} // namespace hearth::test
