// Reads the vertices of a primitive: checks and repairs its attributes and converts them to the arrays of a
// SourceMesh.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/document/accessors.h"

#include <map>

namespace hearth::import
{

/// Counts of dropped and repaired elements by name, so that a message is given once and not for every
/// primitive.
class GltfTally
{
public:
    void dropped(const std::string& what, const std::string& where) { add(Issue::dropped, what, where); }
    void repaired(const std::string& what, const std::string& where) { add(Issue::repaired, what, where); }
    void degraded(const std::string& what, const std::string& where) { add(Issue::degraded, what, where); }
    /// `example` has the numbers of this place; only that of the first place is reported.
    void inconsistent(const std::string& what, const std::string& where, const std::string& example)
    {
        add(Issue::inconsistent, what, where, example);
    }

    /// Report everything, each with its first location and its count.
    void report(PartBuilder& part) const;

private:
    struct Entry
    {
        std::string first_where;
        std::string first_example;
        uint64_t count = 0;
    };
    void add(Issue issue, const std::string& what, const std::string& where, const std::string& example = "");

    std::map<std::pair<Issue, std::string>, Entry> entries_;
};

struct GltfVertices
{
    /// Vertices and morph targets; no triangles, and no normals where the source has none.
    mesh::SourceMesh mesh;
    /// Triangles of the compressed data, if the primitive is compressed.
    std::optional<std::vector<uint32_t>> draco_indices;
};

/// Read the vertices of a primitive that has a POSITION. `where` is its JSON pointer.
/// errors: gltf_value (format of an accessor), gltf_data (counts that differ, positions that are not finite),
/// number_too_large, gltf_extension_value, codec_failed, input_too_large.
Result<GltfVertices> readVertices(const GltfPrimitive& primitive, const std::string& where,
                                  GltfAccessors& accessors, const GltfModel& model,
                                  const GltfBuffers& buffers, const GltfContext& context, GltfTally& tally);

/// Return the accessor of an attribute, or kInvalidIndex.
uint32_t findAttribute(const GltfAttributes& attributes, std::string_view semantic);

} // namespace hearth::import
