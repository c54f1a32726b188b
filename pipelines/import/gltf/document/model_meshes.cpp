// Reads meshes and their primitives.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/model_parts.h"

#include <algorithm>

namespace hearth::import
{

namespace
{

constexpr IntegerRange kModeRange{0, static_cast<uint64_t>(PrimitiveMode::triangle_fan)};

GltfDraco readDraco(const GltfObject& object, const GltfModel& model)
{
    GltfDraco draco;
    draco.buffer_view = object.index("bufferView", model.buffer_views.size(), Need::required);
    if (const auto attributes = object.object("attributes", Need::required))
        draco.attributes = readAttributes(*attributes, kInvalidIndex);
    return draco;
}

GltfPrimitive readPrimitive(const GltfObject& object, const GltfModel& model)
{
    GltfPrimitive primitive;
    if (const auto attributes = object.object("attributes", Need::required))
        primitive.attributes = readAttributes(*attributes, model.accessors.size());
    for (const GltfObject& target : object.objects("targets"))
        primitive.targets.push_back(readAttributes(target, model.accessors.size()));
    primitive.indices = object.index("indices", model.accessors.size());
    primitive.material = object.index("material", model.materials.size());
    primitive.mode = static_cast<PrimitiveMode>(
        object.integer("mode", kModeRange, static_cast<uint64_t>(PrimitiveMode::triangles)));
    if (const auto draco = object.extension("KHR_draco_mesh_compression"))
        primitive.draco = readDraco(*draco, model);
    return primitive;
}

} // namespace

GltfAttributes readAttributes(const GltfObject& object, size_t size)
{
    GltfAttributes attributes;
    const Json& json = object.json();
    for (size_t i = 0; i < json.size() && json.isObject(); ++i)
        attributes.push_back({std::string(json[i].key()), object.index(json[i].key(), size)});
    std::sort(attributes.begin(), attributes.end());
    attributes.erase(std::unique(attributes.begin(), attributes.end()), attributes.end());
    return attributes;
}

GltfProxyMark readProxyMark(const GltfObject& object)
{
    const std::optional<Json> extras = object.json().find("extras");
    const std::optional<Json> mark = extras ? extras->find("hearth_proxy") : std::nullopt;
    if (!mark)
        return GltfProxyMark::absent;
    // Blender makes numbers of custom properties
    const bool is_number = mark->isNumber() && (mark->number() == 0 || mark->number() == 1);
    if (is_number || mark->type() == JsonType::boolean)
        return (is_number ? mark->number() == 1 : mark->boolean()) ? GltfProxyMark::proxy
                                                                   : GltfProxyMark::none;
    if (mark->isString() && mark->string() == "convex")
        return GltfProxyMark::convex;
    object.problems().fail(Issue::gltf_extension_value, *mark,
                           "hearth_proxy must be true, false or \"convex\"");
    return GltfProxyMark::absent;
}

void readMeshes(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("meshes"))
    {
        GltfMesh mesh;
        mesh.name = object.text("name");
        for (const GltfObject& primitive : object.objects("primitives", Need::required))
            mesh.primitives.push_back(readPrimitive(primitive, model));
        mesh.weights = object.numberList("weights");
        mesh.proxy = readProxyMark(object);
        model.meshes.push_back(std::move(mesh));
    }
}

} // namespace hearth::import
