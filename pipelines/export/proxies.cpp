// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/proxies.h"

#include "pipelines/export/accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

/// Return the number of UV sets that the textures of a material need.
uint32_t countUvSets(const Material& material)
{
    uint32_t count = 0;
    const auto use = [&](const TextureUse& texture)
    {
        if (texture.texture != kInvalidIndex)
            count = std::max(count, texture.uv_set + 1);
    };
    for (const TextureUse* const texture :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture})
        use(*texture);
    if (material.specular)
    {
        use(material.specular->texture);
        use(material.specular->color_texture);
    }
    if (material.clearcoat)
    {
        use(material.clearcoat->texture);
        use(material.clearcoat->roughness_texture);
        use(material.clearcoat->normal_texture);
    }
    if (material.sheen)
    {
        use(material.sheen->color_texture);
        use(material.sheen->roughness_texture);
    }
    return count;
}

/// Nodes of which only a name is left: those of proxies lost their meshes when they were cooked. They are
/// used again, since programs rename one of two nodes that have the same name.
class BareNodes
{
public:
    explicit BareNodes(GltfDocument& document)
        : document_(document), parents_(document.nodes.size(), kInvalidIndex)
    {
        std::vector<uint8_t> is_used(document.nodes.size(), 0);
        for (const Skin& skin : document.skins)
            for (const uint32_t joint : skin.joints)
                is_used[joint] = 1;
        for (const Animation& animation : document.animations)
            for (const AnimationChannel& channel : animation.channels)
                if (channel.node != kInvalidIndex)
                    is_used[channel.node] = 1;
        for (uint32_t i = 0; i < document.nodes.size(); ++i)
        {
            for (const uint32_t child : document.nodes[i].children)
                parents_[child] = i;
            if (is_used[i] == 0 && isBare(document.nodes[i]))
                nodes_.emplace(document.nodes[i].name, i); // the first of a name
        }
    }

    /// Take a node of a name out of the scene, without its transform; nothing: there is none.
    std::optional<uint32_t> take(const std::string& name)
    {
        const auto found = nodes_.extract(name);
        if (found.empty())
            return std::nullopt;
        const uint32_t node = found.mapped();
        const uint32_t parent = parents_[node];
        std::erase(parent == kInvalidIndex ? document_.scene_nodes : document_.nodes[parent].children, node);
        document_.nodes[node] = {.name = name};
        return node;
    }

private:
    static bool isBare(const Node& node)
    {
        return node.children.empty() && node.lods.empty() && node.mesh == kInvalidIndex &&
               node.camera == kInvalidIndex && node.light == kInvalidIndex;
    }

    GltfDocument& document_;
    std::vector<uint32_t> parents_;
    std::map<std::string, uint32_t> nodes_;
};

/// Adds the proxies of one mesh.
class ProxyWriter
{
public:
    /// parent  node that has the mesh
    /// name    of the mesh, for names of nodes where the parent has none
    ProxyWriter(GltfDocument& document, const PackView& pack, BareNodes& bare_nodes, uint32_t parent,
                std::string name)
        : document_(document), pack_(pack), bare_nodes_(bare_nodes), parent_(parent), name_(std::move(name))
    {
        if (!document.nodes[parent].name.empty())
            name_ = document.nodes[parent].name;
    }

    void write(const ProxyRecord& proxy)
    {
        const auto sections = recordsInRange(pack_.proxySections(), proxy.sections);
        const auto is_convex = [](const ProxySectionRecord& section) { return section.is_convex != 0; };
        if (std::ranges::none_of(sections, is_convex))
            return addNode(name_ + "_PROXY", "true", addMesh(proxy, sections));
        for (const ProxySectionRecord& section : sections)
            addNode(fmt::format("UCX_{}_{:02}", name_, ++convex_parts_), "\"convex\"",
                    addMesh(proxy, {&section, 1}));
    }

private:
    /// Add a mesh of some sections, with the positions that they use.
    uint32_t addMesh(const ProxyRecord& proxy, std::span<const ProxySectionRecord> sections)
    {
        const auto positions = recordsInRange(pack_.proxyPositions(), proxy.positions);
        const auto indices = recordsInRange(pack_.proxyIndices(), proxy.indices);
        const auto corners = [&](const ProxySectionRecord& section)
        { return indices.subspan(size_t{3} * section.triangles.first, size_t{3} * section.triangles.count); };
        std::vector<uint32_t> new_of_old(positions.size(), kInvalidIndex);
        for (const ProxySectionRecord& section : sections)
            for (const uint32_t index : corners(section))
                new_of_old[index] = 0;
        std::vector<float> values;
        for (size_t i = 0; i < positions.size(); ++i)
            if (new_of_old[i] != kInvalidIndex)
            {
                new_of_old[i] = static_cast<uint32_t>(values.size() / 3);
                values.insert(values.end(), {positions[i].x, positions[i].y, positions[i].z});
            }
        const uint32_t accessor =
            addFloats(document_, values, ElementType::vec3, ViewTarget::vertices, Extremes::stated);
        Mesh mesh;
        for (const ProxySectionRecord& section : sections)
        {
            std::vector<uint32_t> numbers;
            for (const uint32_t index : corners(section))
                numbers.push_back(new_of_old[index]);
            mesh.primitives.push_back(makePrimitive(accessor, numbers, section.material));
        }
        document_.meshes.push_back(std::move(mesh));
        return static_cast<uint32_t>(document_.meshes.size() - 1);
    }

    /// Make a primitive with the UVs that the textures of its material need: a proxy has none, so they are 0.
    Primitive makePrimitive(uint32_t positions, const std::vector<uint32_t>& numbers, uint32_t material)
    {
        Primitive primitive;
        primitive.attributes["POSITION"] = positions;
        primitive.indices = addIndices(document_, numbers);
        primitive.material = material;
        const uint32_t uv_sets =
            material < document_.materials.size() ? countUvSets(document_.materials[material]) : 0;
        const std::vector<float> zeros(uv_sets > 0 ? 2 * document_.accessors[positions].count : 0);
        for (uint32_t set = 0; set < uv_sets; ++set)
            primitive.attributes[fmt::format("TEXCOORD_{}", set)] =
                addFloats(document_, zeros, ElementType::vec2, ViewTarget::vertices);
        return primitive;
    }

    /// Put a mesh into a node below the parent, one that is left of the source if there is one of that name.
    void addNode(const std::string& name, const std::string& mark, uint32_t mesh)
    {
        document_.meshes[mesh].name = name;
        uint32_t index = 0;
        if (const std::optional<uint32_t> bare = bare_nodes_.take(name))
            index = *bare;
        else
        {
            index = static_cast<uint32_t>(document_.nodes.size());
            document_.nodes.push_back({.name = name});
            document_.extras.push_back({fmt::format("/nodes/{}", index), "{\"hearth_proxy\":" + mark + "}"});
        }
        document_.nodes[index].mesh = mesh;
        document_.nodes[parent_].children.push_back(index);
    }

    GltfDocument& document_;
    const PackView& pack_;
    BareNodes& bare_nodes_;
    uint32_t parent_;
    std::string name_;
    size_t convex_parts_ = 0;
};

} // namespace

void addProxies(GltfDocument& document, const PackView& pack, std::span<const uint32_t> meshes,
                Omissions& omissions)
{
    std::vector<uint32_t> node_of_mesh(document.meshes.size(), kInvalidIndex);
    for (uint32_t node = 0; node < document.nodes.size(); ++node)
        if (const uint32_t mesh = document.nodes[node].mesh;
            mesh != kInvalidIndex && node_of_mesh[mesh] == kInvalidIndex)
            node_of_mesh[mesh] = node;
    BareNodes bare_nodes(document);
    const std::span<const ProxyRecord> proxies = pack.proxies();
    for (uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
    {
        const auto of_mesh = std::ranges::equal_range(proxies, mesh, {}, &ProxyRecord::mesh);
        if (of_mesh.empty())
            continue;
        if (meshes[mesh] == kInvalidIndex)
        {
            omissions.add("proxies of meshes that are not in the file", of_mesh.size());
            continue;
        }
        ProxyWriter writer(document, pack, bare_nodes, node_of_mesh[meshes[mesh]],
                           document.meshes[meshes[mesh]].name.empty() ? fmt::format("mesh_{}", mesh)
                                                                      : document.meshes[meshes[mesh]].name);
        for (const ProxyRecord& proxy : of_mesh)
            writer.write(proxy);
    }
}

} // namespace hearth::gltf_export
