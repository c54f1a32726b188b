// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/proxies.h"

#include "pipelines/import/part/proxy_name.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace hearth::import
{

namespace
{

// Maximum of pieces of one mesh, more than decompositions into convex parts have. Each is a copy of its
// mesh: a small file could ask for any number.
constexpr size_t kMaxProxyPieces = 1024;

/// Node or mesh that is called or marked as a proxy.
struct Candidate
{
    GltfProxyPiece piece;
    bool is_marked = false;
    std::vector<std::string> stems;
};

class ProxyFinder
{
public:
    ProxyFinder(const GltfModel& model, const GltfLods& lods, const GltfContext& context)
        : model_(model), lods_(lods), context_(context), is_candidate_(model.nodes.size())
    {
        proxies_.hidden.resize(model.nodes.size());
        proxies_.proxy_only.resize(model.meshes.size());
    }

    Result<GltfProxies> find()
    {
        if (context_.options.proxies != AuthoredProxies::unknown)
            findCandidates();
        if (candidates_.empty() && context_.options.file_proxies == nullptr)
            return std::move(proxies_);
        indexNames();
        for (const Candidate& candidate : candidates_)
            add(candidate);
        for (const auto& [node, piece] : others_)
            addOther(node, piece);
        findProxyOnly();
        if (context_.options.proxies == AuthoredProxies::left_out)
            proxies_.of_mesh.clear();
        if (context_.options.file_proxies != nullptr)
            for (const FileProxies& file : *context_.options.file_proxies)
                HEARTH_TRY(addFile(file));
        return std::move(proxies_);
    }

private:
    std::string where(const GltfProxyPiece& piece) const
    {
        return piece.node == kInvalidIndex ? fmt::format("/meshes/{}", piece.mesh)
                                           : fmt::format("/nodes/{}", piece.node);
    }

    const std::string& nameOrMesh(const GltfProxyPiece& piece) const
    {
        const std::string& of_mesh = model_.meshes[piece.mesh].name;
        return piece.node == kInvalidIndex || model_.nodes[piece.node].name.empty()
                   ? of_mesh
                   : model_.nodes[piece.node].name;
    }

    /// Return what is called or marked as a proxy.
    std::optional<Candidate> readCandidate(uint32_t mesh, uint32_t node) const
    {
        GltfProxyMark mark = model_.meshes[mesh].proxy;
        std::optional<ProxyName> name;
        if (node != kInvalidIndex)
        {
            mark = model_.nodes[node].proxy == GltfProxyMark::absent ? mark : model_.nodes[node].proxy;
            name = parseProxyName(model_.nodes[node].name);
        }
        if (!name)
            name = parseProxyName(model_.meshes[mesh].name);
        const bool is_marked = mark == GltfProxyMark::proxy || mark == GltfProxyMark::convex;
        if (mark == GltfProxyMark::none || (!is_marked && !name))
            return std::nullopt;
        const bool is_convex = is_marked ? mark == GltfProxyMark::convex : name->is_convex;
        return Candidate{{mesh, node, is_convex}, is_marked, name ? name->stems : std::vector<std::string>{}};
    }

    void findCandidates()
    {
        std::vector<bool> has_node(model_.meshes.size());
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
        {
            const uint32_t mesh = model_.nodes[node].mesh;
            if (mesh == kInvalidIndex)
                continue;
            has_node[mesh] = true;
            if (lods_.hidden[node])
                continue;
            if (auto candidate = readCandidate(mesh, node))
            {
                is_candidate_[node] = true;
                candidates_.push_back(*std::move(candidate));
            }
        }
        for (uint32_t mesh = 0; mesh < model_.meshes.size(); ++mesh)
            if (!has_node[mesh] && !lods_.lod_only[mesh])
                if (auto candidate = readCandidate(mesh, kInvalidIndex))
                    candidates_.push_back(*std::move(candidate));
    }

    /// True if the node has a mesh that a proxy can stand for.
    bool isOwner(uint32_t node) const
    {
        return node != kInvalidIndex && model_.nodes[node].mesh != kInvalidIndex && !lods_.hidden[node] &&
               !is_candidate_[node];
    }

    void addName(uint32_t node, const std::string& name)
    {
        if (name.empty())
            return;
        std::string lower = lowerProxyStem(name);
        node_beside_.try_emplace({model_.nodes[node].parent, lower}, node);
        node_of_name_.try_emplace(std::move(lower), node);
    }

    /// Index the names of nodes, then those of their meshes, then those of level 0 without it.
    void indexNames()
    {
        std::set<uint32_t> meshes;
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
            if (isOwner(node))
            {
                addName(node, model_.nodes[node].name);
                meshes.insert(model_.nodes[node].mesh);
                only_owner_ = only_owner_ == kInvalidIndex ? node : only_owner_;
            }
        only_owner_ = meshes.size() == 1 ? only_owner_ : kInvalidIndex;
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
            if (isOwner(node))
                addName(node, model_.meshes[model_.nodes[node].mesh].name);
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
            if (const auto lod = tools::parseLodName(model_.nodes[node].name);
                lod && lod->level == 0 && isOwner(node))
                addName(node, lod->stem);
    }

    /// Return the node for whose mesh a candidate stands, or kInvalidIndex.
    uint32_t findOwner(const Candidate& candidate) const
    {
        const uint32_t node = candidate.piece.node;
        const uint32_t above = node == kInvalidIndex ? kInvalidIndex : model_.nodes[node].parent;
        const auto has_name = [&](const std::string& stem)
        {
            return lowerProxyStem(model_.nodes[above].name) == stem ||
                   lowerProxyStem(model_.meshes[model_.nodes[above].mesh].name) == stem;
        };
        if (isOwner(above) && (candidate.is_marked || std::ranges::any_of(candidate.stems, has_name)))
            return above;
        if (node != kInvalidIndex)
            for (const std::string& stem : candidate.stems)
                if (const auto beside = node_beside_.find({above, stem}); beside != node_beside_.end())
                    return beside->second;
        for (const std::string& stem : candidate.stems)
            if (const auto found = node_of_name_.find(stem); found != node_of_name_.end())
                return found->second;
        return candidate.is_marked ? only_owner_ : kInvalidIndex;
    }

    void hide(const GltfProxyPiece& piece)
    {
        if (piece.node != kInvalidIndex)
            proxies_.hidden[piece.node] = true;
    }

    void warn(const GltfProxyPiece& piece, const std::string& detail) const
    {
        context_.part.warn(Issue::dropped, where(piece), detail);
    }

    void add(const Candidate& candidate)
    {
        const GltfProxyPiece& piece = candidate.piece;
        const uint32_t owner = findOwner(candidate);
        if (owner == kInvalidIndex)
            return addUnknown(candidate);
        hide(piece);
        if (piece.node != kInvalidIndex && model_.nodes[piece.node].has_instancing)
            warn(piece, "instancing of a proxy is not kept");
        GltfProxy& proxy =
            proxies_.of_mesh.try_emplace(model_.nodes[owner].mesh, GltfProxy{owner, {}, {}}).first->second;
        if (proxy.node != owner)
            others_.emplace_back(owner, piece);
        else if (proxy.pieces.size() >= kMaxProxyPieces)
            warn(piece, fmt::format("node {} has more than {} proxies: this one is not kept", owner,
                                    kMaxProxyPieces));
        else
            proxy.pieces.push_back(piece);
    }

    void addUnknown(const Candidate& candidate)
    {
        const std::string& name = nameOrMesh(candidate.piece);
        if (candidate.is_marked)
        {
            hide(candidate.piece);
            return warn(candidate.piece,
                        fmt::format("the proxy \"{}\" is not kept: no mesh is found for which it stands; put "
                                    "it below the node of that mesh, or call it X_PROXY or UCX_X where X is "
                                    "the name of that node",
                                    name));
        }
        warn(candidate.piece,
             fmt::format("\"{}\" is called as a proxy of a mesh \"{}\", which the file does not have: it is "
                         "a mesh like others; correct its name, or set the extra hearth_proxy to false",
                         name, candidate.stems.back()));
    }

    /// Compare a piece with those of the first node that has the same mesh: nodes that share a mesh share its
    /// proxies.
    void addOther(uint32_t owner, const GltfProxyPiece& piece)
    {
        const uint32_t mesh = model_.nodes[owner].mesh;
        const GltfProxy& kept = proxies_.of_mesh.at(mesh);
        if (std::ranges::find(kept.pieces, piece.mesh, &GltfProxyPiece::mesh) == kept.pieces.end())
            warn(piece,
                 fmt::format("mesh {} has other proxies, of node {}: those are kept", mesh, kept.node));
    }

    Status addFile(const FileProxies& file)
    {
        const auto found = node_of_name_.find(lowerProxyStem(file.mesh));
        const uint32_t owner = file.mesh.empty()              ? only_owner_
                               : found == node_of_name_.end() ? kInvalidIndex
                                                              : found->second;
        if (owner == kInvalidIndex)
        {
            std::vector<std::string> names;
            for (const auto& [name, node] : node_of_name_)
                names.push_back(name);
            return findNoMeshError(file, names);
        }
        proxies_.of_mesh.try_emplace(model_.nodes[owner].mesh, GltfProxy{owner, {}, {}})
            .first->second.files.push_back(&file);
        return success();
    }

    void findProxyOnly()
    {
        for (const Candidate& candidate : candidates_)
            proxies_.proxy_only[candidate.piece.mesh] =
                candidate.piece.node == kInvalidIndex ? findOwner(candidate) != kInvalidIndex : true;
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
            if (model_.nodes[node].mesh != kInvalidIndex && !proxies_.hidden[node])
                proxies_.proxy_only[model_.nodes[node].mesh] = false;
    }

    const GltfModel& model_;
    const GltfLods& lods_;
    const GltfContext& context_;
    GltfProxies proxies_;
    std::vector<bool> is_candidate_; ///< nodes
    std::vector<Candidate> candidates_;
    std::map<std::pair<uint32_t, std::string>, uint32_t> node_beside_; ///< by parent and name
    std::map<std::string, uint32_t> node_of_name_;
    uint32_t only_owner_ = kInvalidIndex; ///< first node of the only mesh; none: there are several meshes
    /// nodes that share their mesh with an earlier one that has proxies, each with a proxy of its own
    std::vector<std::pair<uint32_t, GltfProxyPiece>> others_;
};

} // namespace

Result<GltfProxies> findProxies(const GltfModel& model, const GltfLods& lods, const GltfContext& context)
{
    return ProxyFinder(model, lods, context).find();
}

} // namespace hearth::import
