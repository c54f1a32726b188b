// Clusters part with every kind of mesh, for tests of programs that write it again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/program/cluster_part.h"
#include "formats/pack/pack_check.h"
#include "tests/support/shapes.h"
#include "tests/support/small_pack.h"
#include "tests/support/temporary_folder.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace hearth::pages
{

using namespace formats;

inline std::string getMessage(const Status& status)
{
    return status.ok() ? "" : formatMessage(status.error());
}

inline std::string readFile(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline ContainerReader open(const std::string& path)
{
    auto reader = ContainerReader::open(path);
    EXPECT_TRUE(reader.ok()) << path;
    return std::move(*reader);
}

/// Meshes with connected and unconnected triangles, authored LODs, joints and morph targets. The last mesh
/// has no normals.
inline std::vector<mesh::SourceMesh> sampleMeshes()
{
    std::vector<mesh::SourceMesh> meshes{shapes::rock(24, 0.3f),  shapes::rock(12, 0), shapes::soup(300),
                                         shapes::tangle(60, 400), shapes::blocks(8),   shapes::grid(30)};
    for (size_t i = 0; i < 5; ++i)
        meshes[i].normals.resize(meshes[i].vertexCount(), Float3{0, 0.6f, 0.8f});
    meshes[5].normals.clear();
    meshes[2].joint_sets.push_back(std::vector<mesh::Joints4>(meshes[2].vertexCount()));
    meshes[2].weight_sets.push_back(std::vector<Float4>(meshes[2].vertexCount(), {1, 0, 0, 0}));
    mesh::MorphTarget target;
    for (uint32_t v = 0; v < meshes[4].vertexCount(); ++v)
        target.positions.push_back({0, v % 3 == 0 ? 0.25f : 0, 0});
    meshes[4].morph_targets.push_back(std::move(target));
    return meshes;
}

/// Return the settings of a mesh whose vertices have room for visibility.
inline clusters::Config configureVisibility(const std::string& /* mesh */)
{
    clusters::Config config;
    config.visibility = true;
    return config;
}

/// A clusters part of these meshes, in a folder of its own.
class SamplePart : public ::testing::Test
{
protected:
    SamplePart()
    {
        const std::string import_path = folder.file("import.part");
        auto writer = ContainerWriter::create(import_path, ContainerKind::part);
        const std::vector<mesh::SourceMesh> meshes = sampleMeshes();
        for (uint32_t i = 0; i < meshes.size(); ++i)
            EXPECT_TRUE(mesh::writeSourceMesh(*writer, i, meshes[i]).ok());
        EXPECT_TRUE(writer->finish().ok());
        EXPECT_EQ(getMessage(clusters::writeClustersPart(open(import_path), path, configureVisibility, {})),
                  "");
    }

    const test::TemporaryFolder folder;
    const std::string path = folder.file("clusters.part");
};

} // namespace hearth::pages
