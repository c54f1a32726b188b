// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/lods.h"

#include "cook/tools/lod_files.h"
#include "pipelines/import/gltf/mesh_uses.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace hearth::import
{

namespace
{

// Maximum number of levels, more than anybody authors. Each is a copy of its mesh: a small file could ask for
// any number.
constexpr size_t kMaxLods = 64;

std::string nodePointer(uint32_t node)
{
    return fmt::format("/nodes/{}", node);
}

/// Nodes below each node, from one walk over the tree: a query must not cost the depth of the node.
class Subtrees
{
public:
    explicit Subtrees(const GltfModel& model) : spans_(model.nodes.size()), meshes_before_(1, 0)
    {
        // a node is visited twice: on the way down, and after all nodes below it
        std::vector<std::pair<uint32_t, bool>> open;
        for (uint32_t node = 0; node < model.nodes.size(); ++node)
            if (model.nodes[node].parent == kInvalidIndex)
                open.push_back({node, false});
        while (!open.empty())
        {
            const auto [node, done] = open.back();
            open.pop_back();
            if (done)
            {
                spans_[node].end = meshes_before_.size() - 1;
                continue;
            }
            spans_[node].begin = meshes_before_.size() - 1;
            meshes_before_.push_back(meshes_before_.back() +
                                     (model.nodes[node].mesh == kInvalidIndex ? 0 : 1));
            open.push_back({node, true});
            for (const uint32_t child : model.nodes[node].children)
                open.push_back({child, false});
        }
    }

    /// True if `node` is `upper` or below it.
    bool contains(uint32_t upper, uint32_t node) const
    {
        return spans_[upper].begin <= spans_[node].begin && spans_[node].begin < spans_[upper].end;
    }

    bool hasMeshBelow(uint32_t node) const
    {
        return meshes_before_[spans_[node].end] > meshes_before_[spans_[node].begin + 1];
    }

private:
    struct Span
    {
        size_t begin = 0, end = 0;
    };
    std::vector<Span> spans_; ///< for each node, with the nodes below it, in the order of the walk
    std::vector<size_t> meshes_before_;
};

/// Collects chains of levels and the nodes that they hide.
class LodFinder
{
public:
    LodFinder(const GltfModel& model, const GltfContext& context)
        : model_(model), context_(context), subtrees_(model)
    {
        lods_.hidden.resize(model.nodes.size());
        lods_.world_from_node = worldTransforms(model);
        is_lod_.resize(model.nodes.size());
        is_base_.resize(model.nodes.size());
        in_scene_.resize(model.nodes.size());
        for (const GltfScene& scene : model.scenes)
            for (const uint32_t root : scene.nodes)
                in_scene_[root] = true;
    }

    GltfLods find()
    {
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
            if (!model_.nodes[node].lods.empty())
                addMsftLods(node);
        findByName();
        findUnusedMeshes();
        std::stable_sort(lods_.chains.begin(), lods_.chains.end(),
                         [](const GltfLodChain& a, const GltfLodChain& b) { return a.mesh < b.mesh; });
        findLodOnly();
        return std::move(lods_);
    }

private:
    void drop(uint32_t node, const std::string& what) const
    {
        context_.part.warn(Issue::dropped, nodePointer(node), what);
    }

    void hide(uint32_t node)
    {
        std::vector<uint32_t> open{node};
        while (!open.empty())
        {
            const uint32_t next = open.back();
            open.pop_back();
            if (lods_.hidden[next])
                continue;
            lods_.hidden[next] = true;
            open.insert(open.end(), model_.nodes[next].children.begin(), model_.nodes[next].children.end());
        }
    }

    /// Add the levels that the extension MSFT_lod of a node lists.
    void addMsftLods(uint32_t node)
    {
        if (is_lod_[node])
            return drop(node, "a level of detail cannot have levels of its own: its list is not kept");
        std::vector<uint32_t> nodes;
        for (const uint32_t lod : model_.nodes[node].lods)
        {
            if (subtrees_.contains(lod, node))
                drop(node, fmt::format("node {} cannot be a level of detail of what it holds", lod));
            else if (is_base_[lod])
                drop(node, fmt::format("node {} cannot be a level of detail: it has levels of its own", lod));
            else
                nodes.push_back(lod);
        }
        addChain(node, nodes);
    }

    /// Make the nodes levels of `base` if they are usable. They are not drawn in any case.
    void addChain(uint32_t base, const std::vector<uint32_t>& nodes)
    {
        is_base_[base] = true;
        GltfLodChain chain{model_.nodes[base].mesh, base, {}};
        for (const uint32_t node : nodes)
        {
            is_lod_[node] = true;
            hide(node);
            // a node outside of all scenes takes the place of the finer one
            if (model_.nodes[node].parent == kInvalidIndex && !in_scene_[node] &&
                model_.nodes[base].parent != kInvalidIndex)
                lods_.world_from_node[node] =
                    lods_.world_from_node[model_.nodes[base].parent] * model_.nodes[node].parent_from_node;
            if (isUsable(chain, node))
                chain.lods.push_back({model_.nodes[node].mesh, node});
        }
        if (chain.mesh == kInvalidIndex && !nodes.empty())
            return drop(base, "levels of detail of a node without a mesh are not kept");
        addIfNew(std::move(chain));
    }

    bool isUsable(const GltfLodChain& chain, uint32_t node) const
    {
        const uint32_t base = chain.node;
        const GltfNode& n = model_.nodes[node];
        const bool repeated = std::any_of(chain.lods.begin(), chain.lods.end(),
                                          [&](const GltfLod& lod) { return lod.mesh == n.mesh; });
        if (subtrees_.hasMeshBelow(node))
            drop(node, "meshes below a level of detail are not kept");
        if (model_.nodes[base].mesh == kInvalidIndex)
            return false;
        if (n.mesh == kInvalidIndex)
            drop(node, fmt::format("a level of detail of node {} has no mesh: it is not kept", base));
        else if ((n.skin == kInvalidIndex) != (model_.nodes[base].skin == kInvalidIndex))
            drop(node,
                 fmt::format("a level of detail of node {} must be skinned like it: it is not kept", base));
        else if (n.mesh == model_.nodes[base].mesh || repeated)
            drop(node, fmt::format("a level of detail of node {} has the same mesh: it is not kept", base));
        else if (chain.lods.size() >= kMaxLods)
            drop(node, fmt::format("node {} has more than {} levels of detail: this one is not kept", base,
                                   kMaxLods));
        else
            return true;
        return false;
    }

    /// Add a chain unless its mesh has one: nodes that share a mesh share its chain.
    void addIfNew(GltfLodChain chain)
    {
        if (chain.lods.empty())
            return;
        const auto same_mesh =
            std::find_if(lods_.chains.begin(), lods_.chains.end(),
                         [&](const GltfLodChain& other) { return other.mesh == chain.mesh; });
        if (same_mesh == lods_.chains.end())
            return lods_.chains.push_back(std::move(chain));
        const auto same = [](const GltfLod& a, const GltfLod& b) { return a.mesh == b.mesh; };
        if (!std::equal(chain.lods.begin(), chain.lods.end(), same_mesh->lods.begin(), same_mesh->lods.end(),
                        same))
            drop(chain.node, fmt::format("mesh {} has other levels of detail in node {}: those are kept",
                                         chain.mesh, same_mesh->node));
    }

    std::optional<tools::LodName> parseNodeName(uint32_t node) const
    {
        const GltfNode& n = model_.nodes[node];
        std::optional<tools::LodName> name = tools::parseLodName(n.name);
        return name || n.mesh == kInvalidIndex ? name : tools::parseLodName(model_.meshes[n.mesh].name);
    }

    /// Find sibling nodes whose names differ only in the level number.
    void findByName()
    {
        std::map<std::pair<uint32_t, std::string>, std::map<uint32_t, uint32_t>> node_of_level;
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
        {
            const std::optional<tools::LodName> name = parseNodeName(node);
            if (!name || lods_.hidden[node] || is_base_[node])
                continue;
            const auto [first, fresh] =
                node_of_level[{model_.nodes[node].parent, name->stem}].try_emplace(name->level, node);
            if (!fresh && name->level > 0)
                duplicates_.push_back({first->second, node});
        }
        for (const auto& [key, levels] : node_of_level)
        {
            if (levels.begin()->first != 0 || levels.size() < 2)
                continue;
            std::vector<uint32_t> nodes;
            for (const auto& [level, node] : levels)
                if (level > 0)
                    nodes.push_back(node);
            addChain(levels.begin()->second, nodes);
        }
        for (const auto& [first, node] : duplicates_)
            if (is_lod_[first])
            {
                hide(node);
                drop(node, fmt::format("node {} is the same level of detail: this one is not kept", first));
            }
    }

    /// Find meshes that no node has, named as levels of a mesh that is drawn.
    void findUnusedMeshes()
    {
        std::vector<uint32_t> node_of_mesh(model_.meshes.size(), kInvalidIndex);
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
            if (const uint32_t mesh = model_.nodes[node].mesh;
                mesh != kInvalidIndex && node_of_mesh[mesh] == kInvalidIndex)
                node_of_mesh[mesh] = node;
        std::map<std::string, std::map<uint32_t, uint32_t>> mesh_of_level;
        for (uint32_t mesh = 0; mesh < model_.meshes.size(); ++mesh)
            if (const auto name = tools::parseLodName(model_.meshes[mesh].name))
                if ((node_of_mesh[mesh] == kInvalidIndex) != (name->level == 0))
                    mesh_of_level[name->stem].try_emplace(name->level, mesh);
        for (const auto& [stem, levels] : mesh_of_level)
        {
            if (levels.begin()->first != 0 || lods_.hidden[node_of_mesh[levels.begin()->second]])
                continue;
            GltfLodChain chain{levels.begin()->second, node_of_mesh[levels.begin()->second], {}};
            for (const auto& [level, mesh] : levels)
                if (level > 0)
                    chain.lods.push_back({mesh, kInvalidIndex});
            addIfNew(std::move(chain));
        }
    }

    void findLodOnly()
    {
        lods_.lod_only.assign(model_.meshes.size(), false);
        for (const GltfLodChain& chain : lods_.chains)
            for (const GltfLod& lod : chain.lods)
                lods_.lod_only[lod.mesh] = true;
        for (uint32_t node = 0; node < model_.nodes.size(); ++node)
            if (model_.nodes[node].mesh != kInvalidIndex && !lods_.hidden[node])
                lods_.lod_only[model_.nodes[node].mesh] = false;
        for (const GltfLodChain& chain : lods_.chains)
            lods_.lod_only[chain.mesh] = false;
    }

    const GltfModel& model_;
    const GltfContext& context_;
    const Subtrees subtrees_;
    GltfLods lods_;
    std::vector<bool> is_lod_;
    std::vector<bool> in_scene_; ///< roots of scenes
    std::vector<bool> is_base_;
    std::vector<std::pair<uint32_t, uint32_t>> duplicates_; ///< a level, and a later node with the same name
};

} // namespace

GltfLods findLods(const GltfModel& model, const GltfContext& context)
{
    return LodFinder(model, context).find();
}

} // namespace hearth::import
