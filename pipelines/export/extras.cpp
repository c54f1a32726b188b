// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/extras.h"

#include <fmt/format.h>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

/// Return the JSON pointer of an object; nullopt if the document does not have it.
std::optional<std::string> findOwner(const GltfDocument& document, const ExportedObjects& objects,
                                     const ExtrasRecord& record)
{
    const auto element = [&](const char* array, size_t size, uint32_t index) -> std::optional<std::string>
    {
        if (index >= size)
            return std::nullopt;
        return fmt::format("/{}/{}", array, index);
    };
    const auto exported = [&](std::span<const uint32_t> indices)
    { return record.index < indices.size() ? indices[record.index] : kInvalidIndex; };
    const auto first = [&](const char* owner)
    { return record.index == 0 ? std::optional<std::string>(owner) : std::nullopt; };
    switch (static_cast<ExtrasOwner>(record.owner))
    {
    case ExtrasOwner::node:
        return element("nodes", document.nodes.size(), record.index);
    case ExtrasOwner::mesh:
        return element("meshes", document.meshes.size(), exported(objects.meshes));
    case ExtrasOwner::material:
        return element("materials", document.materials.size(), record.index);
    case ExtrasOwner::camera:
        return element("cameras", document.cameras.size(), record.index);
    case ExtrasOwner::light:
        return element("extensions/KHR_lights_punctual/lights", document.lights.size(), record.index);
    case ExtrasOwner::skin:
        return element("skins", document.skins.size(), record.index);
    case ExtrasOwner::animation:
        return element("animations", document.animations.size(), exported(objects.animations));
    case ExtrasOwner::asset:
        return first("/asset");
    case ExtrasOwner::scene:
        return first("/scenes/0");
    case ExtrasOwner::file:
        return first("");
    }
    return std::nullopt;
}

} // namespace

void addExtras(GltfDocument& document, const PackView& pack, const ExportedObjects& objects)
{
    for (const ExtrasRecord& record : pack.extras())
        if (std::optional<std::string> owner = findOwner(document, objects, record))
            document.extras.push_back({std::move(*owner), std::string(pack.text(record.json))});
}

} // namespace hearth::gltf_export
