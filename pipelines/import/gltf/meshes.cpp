// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/meshes.h"

#include "pipelines/import/part/generate_normals.h"
#include "pipelines/import/part/generate_tangents.h"
#include "pipelines/import/part/limit_messages.h"

#include "pipelines/import/gltf/triangles.h"
#include "pipelines/import/part/mesh_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace hearth::import
{

namespace
{

// glTF asks for flat normals if there are none: no edge is smooth
constexpr float kFlat = 0;

// a triangle that all targets move still fits into a geometry page; models of faces have a hundred or two
constexpr size_t kMaxMorphTargets = 1024;

std::string_view modeName(PrimitiveMode mode)
{
    return mode == PrimitiveMode::points ? "points" : "lines";
}

/// Keep the number of targets: a target that moves nothing would be lost in a part with its last array.
void keepEmptyTargets(mesh::SourceMesh& mesh)
{
    for (mesh::MorphTarget& target : mesh.morph_targets)
        if (target.positions.empty() && target.normals.empty() && target.tangents.empty())
            target.positions.resize(mesh.vertexCount());
}

/// Return the texture that tells a material's tangents: of the surface, else of its clear coat.
const GltfTextureUse& normalTexture(const GltfMaterial& material)
{
    return material.normal_texture.texture == kInvalidIndex ? material.layers.clearcoat_normal_texture
                                                            : material.normal_texture;
}

} // namespace

Result<mesh::SourceMesh> GltfMeshReader::read(uint32_t mesh_index)
{
    const GltfMesh& mesh = model_.meshes[mesh_index];
    // drop data of the previous mesh
    buffers_.releasePages();
    piece_of_key_.clear();
    pieces_.clear();
    for (size_t i = 0; i < mesh.primitives.size(); ++i)
    {
        const GltfPrimitive& primitive = mesh.primitives[i];
        const std::string where = fmt::format("/meshes/{}/primitives/{}", mesh_index, i);
        if (primitive.mode < PrimitiveMode::triangles)
            tally_.dropped(fmt::format("primitive of {} is not kept", modeName(primitive.mode)), where);
        else if (findAttribute(primitive.attributes, "POSITION") == kInvalidIndex)
            tally_.dropped("primitive without POSITION is not kept", where);
        else
        {
            HEARTH_ASSIGN_OR_RETURN(const uint32_t piece, findOrAddPiece(primitive, where));
            HEARTH_TRY(addTriangles(primitive, where, pieces_[piece]));
        }
    }

    std::vector<mesh::SourceMesh> parts;
    for (Piece& piece : pieces_)
    {
        finishPiece(piece);
        parts.push_back(std::move(piece.vertices.mesh));
    }
    mesh::SourceMesh result = mergePieces(std::move(parts));
    keepEmptyTargets(result);
    result.name = mesh.name;
    result.face_count = static_cast<uint32_t>(result.triangleCount());
    result.source_vertex_count = static_cast<uint32_t>(sourceVertexCount(mesh));
    HEARTH_TRY(checkSize(result, fmt::format("/meshes/{}", mesh_index)));
    return result;
}

Status GltfMeshReader::checkSize(const mesh::SourceMesh& mesh, const std::string& where) const
{
    const auto check = [&](uint64_t count, std::string_view things, uint64_t limit)
    {
        return count <= limit ? success()
                              : Status(context_.error(Issue::input_too_large, where,
                                                      describeExcess(count, things, limit)));
    };
    HEARTH_TRY(check(mesh.vertexCount(), "vertices", context_.options.limits.max_vertices));
    HEARTH_TRY(check(mesh.triangleCount(), "triangles", context_.options.limits.max_triangles));
    return check(mesh.morph_targets.size(), "morph targets", kMaxMorphTargets);
}

uint64_t GltfMeshReader::sourceVertexCount(const GltfMesh& mesh) const
{
    std::set<uint32_t> positions;
    for (const GltfPrimitive& primitive : mesh.primitives)
        positions.insert(findAttribute(primitive.attributes, "POSITION"));
    positions.erase(kInvalidIndex);
    uint64_t count = 0;
    for (const uint32_t accessor : positions)
        count += model_.accessors[accessor].count;
    return std::min<uint64_t>(count, UINT32_MAX);
}

Result<uint32_t> GltfMeshReader::findOrAddPiece(const GltfPrimitive& primitive, const std::string& where)
{
    const auto next = static_cast<uint32_t>(pieces_.size());
    const auto [found, added] =
        piece_of_key_.try_emplace({primitive.attributes, primitive.targets, primitive.draco}, next);
    if (added)
    {
        HEARTH_ASSIGN_OR_RETURN(GltfVertices vertices, readVertices(primitive, where, accessors_, model_,
                                                                    buffers_, context_, tally_));
        pieces_.push_back({std::move(vertices), where});
    }
    return found->second;
}

Result<std::vector<uint32_t>> GltfMeshReader::readIndices(const GltfPrimitive& primitive, const Piece& piece)
{
    const size_t vertex_count = piece.vertices.mesh.vertexCount();
    if (piece.vertices.draco_indices)
        return *piece.vertices.draco_indices;
    if (primitive.indices == kInvalidIndex)
    {
        std::vector<uint32_t> indices(vertex_count);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    const GltfAccessor& accessor = accessors_.accessor(primitive.indices);
    if (accessor.type != ElementType::scalar ||
        (accessor.component != ComponentType::u8 && accessor.component != ComponentType::u16 &&
         accessor.component != ComponentType::u32))
        return accessors_.error(primitive.indices, Issue::gltf_value,
                                fmt::format("indices cannot be a {}", formatName(accessor)));
    HEARTH_ASSIGN_OR_RETURN(std::vector<uint32_t> indices, accessors_.integers(primitive.indices));
    const auto bad =
        std::find_if(indices.begin(), indices.end(), [&](uint32_t index) { return index >= vertex_count; });
    if (bad != indices.end())
        return accessors_.error(primitive.indices, Issue::index_out_of_range,
                                fmt::format("index {} is {}, but there are {} vertices",
                                            bad - indices.begin(), *bad, vertex_count));
    return indices;
}

Status GltfMeshReader::addTriangles(const GltfPrimitive& primitive, const std::string& where, Piece& piece)
{
    HEARTH_ASSIGN_OR_RETURN(std::vector<uint32_t> indices, readIndices(primitive, piece));
    // Draco decodes triangles, whatever the mode says
    const PrimitiveMode mode = piece.vertices.draco_indices ? PrimitiveMode::triangles : primitive.mode;
    const size_t index_count = indices.size();
    const std::vector<uint32_t> triangles = makeTriangleList(std::move(indices), mode);
    const bool whole = mode == PrimitiveMode::triangles ? index_count % 3 == 0 : index_count >= 3;
    if (!whole)
        tally_.dropped("indices that make no whole triangle are not kept", where);

    mesh::SourceMesh& mesh = piece.vertices.mesh;
    if (triangles.size() / 3 > context_.options.limits.max_triangles - mesh.triangleCount())
        return context_.error(Issue::input_too_large, where,
                              describeExcess(mesh.triangleCount() + triangles.size() / 3, "triangles",
                                             context_.options.limits.max_triangles));
    mesh.indices.insert(mesh.indices.end(), triangles.begin(), triangles.end());
    mesh.triangle_materials.resize(mesh.triangleCount(), primitive.material);
    return success();
}

void GltfMeshReader::finishPiece(Piece& piece)
{
    mesh::SourceMesh& mesh = piece.vertices.mesh;
    reportMissingUvs(piece);
    if (mesh.normals.empty())
        generateNormals(mesh, kFlat);
    else
        fillZeroNormals(mesh);
    finishTangents(piece);
}

/// Keep or generate tangents for the first normal texture of the piece; remove them if there is none.
void GltfMeshReader::finishTangents(Piece& piece)
{
    mesh::SourceMesh& mesh = piece.vertices.mesh;
    const auto material = std::find_if(mesh.triangle_materials.begin(), mesh.triangle_materials.end(),
                                       [&](uint32_t m) {
                                           return m != kInvalidIndex &&
                                                  normalTexture(model_.materials[m]).texture != kInvalidIndex;
                                       });
    if (material == mesh.triangle_materials.end())
    {
        if (!mesh.tangents.empty())
            tally_.dropped("TANGENT that no normal texture uses is not kept", piece.where);
        mesh.tangents.clear();
        return;
    }
    const uint32_t uv_set = normalTexture(model_.materials[*material]).uv_set;
    if (mesh.tangents.empty() && uv_set < mesh::kUvSetCount && !mesh.uvs[uv_set].empty())
        generateTangents(mesh, uv_set);
}

void GltfMeshReader::reportMissingUvs(const Piece& piece)
{
    const mesh::SourceMesh& mesh = piece.vertices.mesh;
    uint32_t last = kInvalidIndex;
    for (const uint32_t material : mesh.triangle_materials)
    {
        if (material == kInvalidIndex || material == last)
            continue;
        last = material;
        const GltfMaterial& m = model_.materials[material];
        std::vector<const GltfTextureUse*> uses{&m.base_color_texture, &m.metallic_roughness_texture,
                                                &m.normal_texture, &m.occlusion_texture, &m.emissive_texture};
        for (const GltfTextureUse* use : m.layers.textures())
            uses.push_back(use);
        for (const GltfTextureUse* use : uses)
            if (use->texture != kInvalidIndex && use->uv_set < mesh::kUvSetCount &&
                mesh.uvs[use->uv_set].empty())
                tally_.degraded(fmt::format("material {} needs TEXCOORD_{}, which the primitive lacks",
                                            material, use->uv_set),
                                piece.where);
    }
}

} // namespace hearth::import
