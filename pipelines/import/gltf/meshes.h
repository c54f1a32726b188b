// Reads meshes: the primitives of a glTF mesh become one SourceMesh.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/gltf/vertices.h"

namespace hearth::import
{

class GltfMeshReader
{
public:
    GltfMeshReader(const GltfModel& model, const GltfBuffers& buffers, GltfAccessors& accessors,
                   const GltfContext& context, GltfTally& tally)
        : model_(model), buffers_(buffers), accessors_(accessors), context_(context), tally_(tally)
    {
    }

    /// Read the triangles of all primitives, with one material each. Vertices that primitives share stay
    /// shared. Points and lines are dropped and named in a warning. Missing normals are generated flat, as
    /// the specification asks; tangents are generated where a normal texture needs them. Skins and morph
    /// targets are not applied.
    /// errors: those of readVertices, gltf_value, gltf_data, index_out_of_range, input_too_large.
    Result<mesh::SourceMesh> read(uint32_t mesh_index);

private:
    /// Primitives that share vertices.
    struct Piece
    {
        GltfVertices vertices;
        std::string where;
    };

    Status checkSize(const mesh::SourceMesh& mesh, const std::string& where) const;
    uint64_t sourceVertexCount(const GltfMesh& mesh) const;
    Result<uint32_t> findOrAddPiece(const GltfPrimitive& primitive, const std::string& where);
    Status addTriangles(const GltfPrimitive& primitive, const std::string& where, Piece& piece);
    Result<std::vector<uint32_t>> readIndices(const GltfPrimitive& primitive, const Piece& piece);
    void finishPiece(Piece& piece);
    void finishTangents(Piece& piece);
    void reportMissingUvs(const Piece& piece);

    using PieceKey = std::tuple<GltfAttributes, std::vector<GltfAttributes>, std::optional<GltfDraco>>;

    const GltfModel& model_;
    const GltfBuffers& buffers_;
    GltfAccessors& accessors_;
    const GltfContext& context_;
    GltfTally& tally_;
    std::map<PieceKey, uint32_t> piece_of_key_; ///< for the mesh that is being read
    std::vector<Piece> pieces_;
};

} // namespace hearth::import
