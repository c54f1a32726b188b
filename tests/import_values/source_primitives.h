// Triangles of a glTF mesh in the order of its import part, with the values of all attributes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/import_values/source_model.h"

#include <array>
#include <optional>

namespace hearth::test
{

inline constexpr size_t kUvSets = 4;

struct SourceTriangle
{
    std::array<size_t, 3> vertices{};
    int material = -1; ///< -1: none
};

struct SourceTarget
{
    std::optional<SourceValues> positions;
    std::optional<SourceValues> normals;
    std::optional<SourceValues> tangents;
};

/// Primitives with equal attributes, which share their vertices.
struct SourcePiece
{
    SourceValues positions;
    std::optional<SourceValues> normals;
    std::optional<SourceValues> tangents;
    std::array<std::optional<SourceValues>, kUvSets> uvs;
    std::optional<SourceValues> colors;
    std::vector<SourceValues> joints; ///< as many sets as weights
    std::vector<SourceValues> weights;
    std::vector<SourceTarget> targets;
    std::vector<SourceTriangle> triangles;
    bool has_normal_texture = false; ///< of one of its materials
};

/// Return the pieces of a mesh, each at the place of its first primitive. Points, lines and primitives
/// without positions are left out. Throws std::runtime_error if Draco data cannot be decoded.
std::vector<SourcePiece> readPieces(const SourceModel& source, const tinygltf::Mesh& mesh);

/// Return the vertices of the triangles of a primitive's indices, by section 3.7.2.1 of the specification.
std::vector<std::array<size_t, 3>> triangulate(const std::vector<size_t>& indices, int mode);

} // namespace hearth::test
