// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/mesh_writer.h"

#include "pipelines/import/gltf/skinning.h"
#include "pipelines/import/part/bake_transform.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/limit_messages.h"
#include "pipelines/import/part/part_proxies.h"
#include "pipelines/import/part/receiver_uvs.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hearth::import
{

namespace
{

// Maximum of triangles of all proxies of a mesh: they are in memory at once, and small by nature.
constexpr size_t kMaxProxyTriangles = size_t{1} << 22;

/// Remove joints and weights of a mesh that no skin moves: their indices refer to nothing.
void dropInfluences(mesh::SourceMesh& mesh)
{
    mesh.joint_sets.clear();
    mesh.weight_sets.clear();
}

class MeshWriter
{
public:
    MeshWriter(const GltfModel& model, const MeshUses& uses, const GltfLods& lods, const GltfProxies& proxies,
               GltfMeshReader& reader, std::span<const InverseBinds> inverse_binds,
               const GltfContext& context)
        : model_(model),
          uses_(uses),
          lods_(lods),
          proxies_(proxies),
          reader_(reader),
          inverse_binds_(inverse_binds),
          context_(context),
          world_from_node_(worldTransforms(model)),
          counted_(model.meshes.size())
    {
    }

    Status writeMesh(const MeshUse& use);
    Status writeLods(const GltfLodChain& chain);
    std::vector<MeshSummary> summaries() { return std::move(summaries_); }

private:
    struct MeshWithSummary
    {
        mesh::SourceMesh mesh;
        MeshSummary summary;
    };
    Result<MeshWithSummary> read(const MeshUse& use);
    MeshUse meshUseForLod(const GltfLodChain& chain, const GltfLod& lod) const;
    tools::LodLabel makeLabel(const GltfLod& lod) const;
    double texelSizeInMesh() const;
    Status writeProxies(const GltfProxy& proxy, const mesh::SourceMesh& of);
    Status writeFileProxies(const GltfProxy& proxy, const mesh::SourceMesh& of);
    std::optional<Transform> objectFromPiece(const GltfProxy& proxy, const GltfProxyPiece& piece) const;
    std::optional<Transform> objectFromLod(const GltfLodChain& chain, const GltfLod& lod,
                                           const MeshSummary& summary) const;

    const GltfModel& model_;
    const MeshUses& uses_;
    const GltfLods& lods_;
    const GltfProxies& proxies_;
    GltfMeshReader& reader_;
    std::span<const InverseBinds> inverse_binds_;
    const GltfContext& context_;
    std::vector<Transform> world_from_node_;
    std::vector<bool> counted_; ///< meshes that are in the counts: a mesh may be a level of several others
    std::vector<MeshSummary> summaries_;
};

Result<MeshWriter::MeshWithSummary> MeshWriter::read(const MeshUse& use)
{
    HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh mesh, reader_.read(use.mesh));
    MeshSummary summary{mesh.triangleCount() > 0, {}, SkinState::idle, false, mesh.morph_targets.size()};
    if (use.skin != kInvalidIndex)
    {
        summary.used_joints = usedJoints(mesh);
        // writeScene refuses a skin with too few joints
        if (const GltfSkin& skin = model_.skins[use.skin]; summary.used_joints.size() <= skin.joints.size())
        {
            const InverseBinds& inverse_binds = inverse_binds_[use.skin];
            summary.skin = skinState(mesh, summary.used_joints, skin, inverse_binds, world_from_node_);
            summary.skin_mirrors = skinMirrors(summary.used_joints, skin, inverse_binds, world_from_node_);
        }
    }
    if (summary.skin != SkinState::usable)
        dropInfluences(mesh);
    if (!counted_[use.mesh])
    {
        counted_[use.mesh] = true;
        context_.part.counts.triangles += mesh.triangleCount();
        context_.part.counts.faces += mesh.face_count;
        context_.part.counts.morph_targets += mesh.morph_targets.size();
    }
    return MeshWithSummary{std::move(mesh), std::move(summary)};
}

/// Return the size of receivers' texels in the next mesh, by the smallest node that draws it once; 0 if it
/// gets no UVs for them: no such node, or levels of detail that the source brings without such UVs.
double MeshWriter::texelSizeInMesh() const
{
    const auto mesh = static_cast<uint32_t>(summaries_.size());
    const auto is_of_mesh = [&](const GltfLodChain& chain) { return uses_.of_node[chain.node] == mesh; };
    if (context_.options.receiver_texel_size == 0 || std::ranges::any_of(lods_.chains, is_of_mesh))
        return 0;
    double least = 0;
    for (size_t node = 0; node < model_.nodes.size(); ++node)
    {
        if (uses_.of_node[node] != mesh || model_.nodes[node].has_instancing)
            continue;
        const double scale = std::cbrt(std::abs(determinant(world_from_node_[node])));
        if (scale > 0 && (least == 0 || scale < least))
            least = scale;
    }
    return least > 0 ? context_.options.receiver_texel_size / least : 0;
}

Status MeshWriter::writeMesh(const MeshUse& use)
{
    if (lods_.lod_only[use.mesh] || proxies_.proxy_only[use.mesh])
    {
        mesh::SourceMesh empty;
        empty.name = model_.meshes[use.mesh].name;
        summaries_.emplace_back();
        return context_.part.addMesh(empty);
    }
    HEARTH_ASSIGN_OR_RETURN(MeshWithSummary read, this->read(use));
    if (const double texel_size = texelSizeInMesh(); texel_size > 0)
        addReceiverUvs(read.mesh, texel_size);
    summaries_.push_back(std::move(read.summary));
    HEARTH_TRY(context_.part.addMesh(read.mesh));
    const auto proxy = proxies_.of_mesh.find(use.mesh);
    return proxy == proxies_.of_mesh.end() ? success() : writeProxies(proxy->second, read.mesh);
}

/// Return the transform from a proxy's vertices to its mesh. If a skin moves both, they share a bind pose.
std::optional<Transform> MeshWriter::objectFromPiece(const GltfProxy& proxy,
                                                     const GltfProxyPiece& piece) const
{
    if (piece.node == kInvalidIndex)
        return Transform{};
    const uint32_t skin = model_.nodes[piece.node].skin;
    if (skin != kInvalidIndex && skin == model_.nodes[proxy.node].skin)
        return Transform{};
    const Transform& world_from_object = world_from_node_[proxy.node];
    const Transform& world_from_piece = world_from_node_[piece.node];
    if (model_.nodes[piece.node].parent == proxy.node)
        return model_.nodes[piece.node].parent_from_node;
    if (distance(world_from_object, world_from_piece) == 0)
        return Transform{};
    const std::optional<Transform> object_from_world = inverted(world_from_object);
    return object_from_world ? std::optional(*object_from_world * world_from_piece) : std::nullopt;
}

/// Write the proxies from files of the mesh that was written last. They lie where the first node with the
/// mesh draws it.
Status MeshWriter::writeFileProxies(const GltfProxy& proxy, const mesh::SourceMesh& of)
{
    const std::optional<Transform> object_from_world = inverted(world_from_node_[proxy.node]);
    std::vector<std::string_view> material_names;
    for (const GltfMaterial& material : model_.materials)
        material_names.push_back(material.name);
    std::vector<ProxyPiece> pieces;
    for (const FileProxies* const file : proxy.files)
        for (const FileProxyPiece& from_file : file->pieces)
        {
            ProxyPiece piece = matchMaterials(material_names, from_file);
            if (!object_from_world || !bakeTransform(piece.mesh, *object_from_world))
                return context_.error(Issue::usage, fmt::format("/nodes/{}", proxy.node),
                                      fmt::format("--proxy {}: the proxy cannot be moved to the mesh of this "
                                                  "node, whose transform has no inverse",
                                                  file->word));
            pieces.push_back(std::move(piece));
        }
    addProxies(static_cast<uint32_t>(summaries_.size()) - 1, of, pieces, context_.part);
    return success();
}

/// Write the proxies of the mesh that was written last.
Status MeshWriter::writeProxies(const GltfProxy& proxy, const mesh::SourceMesh& of)
{
    if (!proxy.files.empty())
        return writeFileProxies(proxy, of);
    std::vector<ProxyPiece> pieces;
    size_t triangles = 0;
    for (const GltfProxyPiece& piece : proxy.pieces)
    {
        HEARTH_ASSIGN_OR_RETURN(MeshWithSummary read, this->read({piece.mesh, kInvalidIndex}));
        const std::string where = piece.node == kInvalidIndex ? fmt::format("/meshes/{}", piece.mesh)
                                                              : fmt::format("/nodes/{}", piece.node);
        triangles += read.mesh.triangleCount();
        if (triangles > kMaxProxyTriangles)
            return context_.error(
                Issue::input_too_large, where,
                describeExcess(triangles, "triangles of proxies of one mesh", kMaxProxyTriangles));
        const std::optional<Transform> object_from_piece = objectFromPiece(proxy, piece);
        if (!object_from_piece || !bakeTransform(read.mesh, *object_from_piece))
            context_.part.warn(
                Issue::dropped, where,
                fmt::format("a proxy cannot be moved to its mesh, by a transform without inverse or to "
                            "coordinates beyond {:g}: it is not kept",
                            kMaxCoordinate));
        else
            pieces.push_back({std::move(read.mesh), piece.is_convex, where});
    }
    addProxies(static_cast<uint32_t>(summaries_.size()) - 1, of, pieces, context_.part);
    return success();
}

/// Return the mesh of the part for a level. A level without a node is moved by the skin of the finer mesh.
MeshUse MeshWriter::meshUseForLod(const GltfLodChain& chain, const GltfLod& lod) const
{
    return {lod.mesh, model_.nodes[lod.node == kInvalidIndex ? chain.node : lod.node].skin};
}

/// Return the transform from the level's vertices to its mesh. If joints move both, they share a bind pose.
std::optional<Transform> MeshWriter::objectFromLod(const GltfLodChain& chain, const GltfLod& lod,
                                                   const MeshSummary& summary) const
{
    if (lod.node == kInvalidIndex || summary.skin == SkinState::usable)
        return Transform{};
    const Transform& world_from_object = lods_.world_from_node[chain.node];
    const Transform& world_from_lod = lods_.world_from_node[lod.node];
    if (distance(world_from_object, world_from_lod) == 0)
        return Transform{};
    const std::optional<Transform> object_from_world = inverted(world_from_object);
    return object_from_world ? std::optional(*object_from_world * world_from_lod) : std::nullopt;
}

/// Return the name of the node, or of its mesh if only that has a level number or the node has no name.
tools::LodLabel MeshWriter::makeLabel(const GltfLod& lod) const
{
    const std::string& mesh_name = model_.meshes[lod.mesh].name;
    const std::string& of_node = lod.node == kInvalidIndex ? mesh_name : model_.nodes[lod.node].name;
    for (const std::string& name : {of_node, mesh_name})
        if (const auto parsed = tools::parseLodName(name))
            return {parsed->level, name};
    return {std::nullopt, of_node.empty() ? mesh_name : of_node};
}

Status MeshWriter::writeLods(const GltfLodChain& chain)
{
    const uint32_t finest = uses_.of_node[chain.node];
    const MeshSummary& base = summaries_[finest];
    if (!base.has_triangles)
        return success();
    for (const GltfLod& lod : chain.lods)
    {
        const MeshUse use = meshUseForLod(chain, lod);
        HEARTH_ASSIGN_OR_RETURN(MeshWithSummary level, read(use));
        const std::string where = fmt::format("/meshes/{}", lod.mesh);
        const auto drop = [&](std::string_view why)
        {
            context_.part.warn(
                Issue::dropped, where,
                fmt::format("a level of detail of mesh {} {}: it is not kept", chain.mesh, why));
        };
        const std::optional<Transform> object_from_lod = objectFromLod(chain, lod, level.summary);
        if (!level.summary.has_triangles)
            drop("has no triangles");
        else if (level.summary.skin != base.skin ||
                 (base.skin == SkinState::usable && use.skin != uses_.uses[finest].skin))
            drop("has not the skin of that");
        else if (!object_from_lod || !bakeTransform(level.mesh, *object_from_lod))
            drop(fmt::format("cannot be moved to its place, by a transform without inverse or to coordinates "
                             "beyond {:g}",
                             kMaxCoordinate));
        else
            HEARTH_TRY(context_.part.addLod(finest, level.mesh, makeLabel(lod)));
    }
    return success();
}

} // namespace

Result<std::vector<MeshSummary>>
writeMeshes(const GltfModel& model, const MeshUses& uses, const GltfLods& lods, const GltfProxies& proxies,
            GltfMeshReader& reader, std::span<const InverseBinds> inverse_binds, const GltfContext& context)
{
    MeshWriter writer(model, uses, lods, proxies, reader, inverse_binds, context);
    for (const MeshUse& use : uses.uses)
        HEARTH_TRY(writer.writeMesh(use));
    for (const GltfLodChain& chain : lods.chains)
        HEARTH_TRY(writer.writeLods(chain));
    return writer.summaries();
}

} // namespace hearth::import
