// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/proxies.h"

#include "pipelines/export/accessors.h"

#include <fmt/format.h>

#include <algorithm>

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

/// Adds the proxies of one mesh.
class ProxyWriter
{
public:
    /// parent  node that has the mesh
    /// name    of the mesh, for names of nodes where the parent has none
    ProxyWriter(GltfDocument& document, const PackView& pack, uint32_t parent, std::string name)
        : document_(document), pack_(pack), parent_(parent), name_(std::move(name))
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

    /// Give the mesh to a node below the parent: one of that name that is left of the source, or a new one.
    void addNode(const std::string& name, const std::string& mark, uint32_t mesh)
    {
        document_.meshes[mesh].name = name;
        for (const uint32_t child : document_.nodes[parent_].children)
            if (isLeft(document_.nodes[child], name))
            {
                document_.nodes[child].mesh = mesh;
                return;
            }
        Node node;
        node.name = name;
        node.mesh = mesh;
        const auto index = static_cast<uint32_t>(document_.nodes.size());
        document_.nodes[parent_].children.push_back(index);
        document_.nodes.push_back(std::move(node));
        document_.extras.push_back({fmt::format("/nodes/{}", index), "{\"hearth_proxy\":" + mark + "}"});
    }

    /// True if a node lost the mesh of a proxy when it was cooked, and stands where that mesh stands.
    static bool isLeft(const Node& node, const std::string& name)
    {
        const Node plain;
        return node.name == name && node.mesh == kInvalidIndex && node.children.empty() && !node.matrix &&
               node.translation == plain.translation && node.rotation == plain.rotation &&
               node.scale == plain.scale;
    }

    GltfDocument& document_;
    const PackView& pack_;
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
        ProxyWriter writer(document, pack, node_of_mesh[meshes[mesh]],
                           document.meshes[meshes[mesh]].name.empty() ? fmt::format("mesh_{}", mesh)
                                                                      : document.meshes[meshes[mesh]].name);
        for (const ProxyRecord& proxy : of_mesh)
            writer.write(proxy);
    }
}

} // namespace hearth::gltf_export
