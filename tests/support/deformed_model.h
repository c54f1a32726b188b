// Deformed mesh of a source file with its hierarchy, in any pose of its scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/levels/validate.h"
#include "cook/clusters/program/part_motion.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"

#include <array>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace hearth::test
{

/// Skinning matrices and morph weights of a mesh in one pose.
struct MeshPose
{
    std::vector<Affine3d> palette; ///< one matrix for a mesh without a skin
    std::vector<double> morph_weights;
    double scale = 1; ///< upper bound of the largest singular value of the palette
};

/// Poses of a node's mesh from clips and their blends, at any time.
class MeshPoses
{
public:
    MeshPoses(const formats::AnimationTables& tables, uint32_t node, uint32_t seed);
    MeshPose next();
    MeshPose rest();
    /// Pose of a single clip at a time in seconds.
    MeshPose at(uint32_t animation, double time_s);

private:
    void sample(formats::ScenePose& pose);
    MeshPose place(const formats::ScenePose& pose);

    formats::AnimationTables tables_;
    uint32_t node_;
    std::mt19937 random_;
    formats::ScenePose from_, to_;
    std::vector<uint32_t> order_;
    std::vector<Affine3d> world_from_node_;
};

/// Compute the vertices of a source mesh in a pose by glTF's definition of skinning: slow and obvious.
std::vector<Float3> posed(const mesh::SourceMesh& mesh, const MeshPose& pose);

/// Triangles of all clusters. Vertices whose position and deformation data are equal bit for bit are merged.
class DeformedClusters
{
public:
    explicit DeformedClusters(const clusters::Hierarchy& hierarchy);

    std::span<const uint32_t> getTriangles(uint32_t cluster) const { return triangles_[cluster]; }
    std::vector<uint32_t> getTriangles(std::span<const uint32_t> clusters) const;
    std::vector<Float3> posed(const MeshPose& pose) const;
    size_t vertexCount() const { return keys_.size(); }

private:
    struct Vertex
    {
        Float3 position;
        std::array<uint32_t, 8> joints, weights;
        std::vector<std::pair<uint32_t, Float3>> deltas; ///< target and delta
    };
    std::map<std::vector<uint32_t>, uint32_t> keys_;
    std::vector<Vertex> vertices_;
    std::vector<std::vector<uint32_t>> triangles_;
};

/// Import part with its scene, and the meshes that joints or morph targets move.
class DeformedModel
{
public:
    /// Import a source with the real program; null on failure.
    static std::unique_ptr<DeformedModel> import(const std::string& source);

    /// Import with the source's clips, uncompressed.
    static std::unique_ptr<DeformedModel> importExactly(const std::string& source);

    struct Mesh
    {
        uint32_t index;
        uint32_t node; ///< a node that has it
        mesh::SourceMesh source;
    };
    const std::vector<Mesh>& meshes() const { return meshes_; }
    const formats::PackView& scene() const { return *scene_; }
    const clusters::PartMotion& motion() const { return *motion_; }

private:
    static std::unique_ptr<DeformedModel> importWith(const std::string& source, const std::string& profile);

    std::unique_ptr<formats::PackView> scene_;
    std::unique_ptr<clusters::PartMotion> motion_;
    std::vector<Mesh> meshes_;
};

} // namespace hearth::test
