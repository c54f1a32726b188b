// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/model.h"

#include "pipelines/import/gltf/document/model_parts.h"
#include "pipelines/import/gltf/document/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace hearth::import
{

namespace
{

/// Extensions that Hearth reads, so that a file may require them.
constexpr std::string_view kSupportedExtensions[] = {
    "EXT_lights_image_based",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "MSFT_lod",
    "MSFT_texture_dds",
};

bool isSupported(std::string_view name)
{
    return std::find(std::begin(kSupportedExtensions), std::end(kSupportedExtensions), name) !=
           std::end(kSupportedExtensions);
}

struct Version
{
    unsigned major = 0;
    unsigned minor = 0;
};

/// Parse "2.0"; nullopt for other forms.
std::optional<Version> parseVersion(std::string_view text)
{
    constexpr size_t kMaxDigits = 4;
    const size_t dot = text.find('.');
    if (dot == std::string_view::npos)
        return std::nullopt;
    const auto number = [](std::string_view digits) -> std::optional<unsigned>
    {
        unsigned value = 0;
        for (const char c : digits)
        {
            if (c < '0' || c > '9')
                return std::nullopt;
            value = value * 10 + static_cast<unsigned>(c - '0');
        }
        return digits.empty() || digits.size() > kMaxDigits ? std::nullopt : std::optional(value);
    };
    const auto major = number(text.substr(0, dot));
    const auto minor = number(text.substr(dot + 1));
    return major && minor ? std::optional(Version{*major, *minor}) : std::nullopt;
}

void checkVersion(const GltfObject& root)
{
    const auto asset = root.object("asset", Need::required);
    if (!asset)
        return;
    const std::string text = asset->text("version", Need::required);
    const std::optional<Version> version = parseVersion(text);
    if (!version || version->major != 2)
        root.problems().fail(Issue::gltf_version, asset->json(), fmt::format("the version is \"{}\"", text));
    if (!asset->has("minVersion"))
        return;
    const std::string min_text = asset->text("minVersion");
    const std::optional<Version> min = parseVersion(min_text);
    if (!min || min->major != 2 || min->minor > 0)
        root.problems().fail(Issue::gltf_version, asset->json(),
                             fmt::format("the minVersion is \"{}\"", min_text));
}

std::vector<std::string> readNames(const GltfObject& root, std::string_view list)
{
    std::vector<std::string> names;
    const std::optional<Json> array = root.json().find(list);
    if (!array)
        return names;
    if (!array->isArray())
        root.problems().fail(Issue::gltf_structure, *array, "must be an array");
    for (size_t i = 0; i < array->size(); ++i)
    {
        const Json name = (*array)[i];
        if (name.isString())
            names.emplace_back(name.string());
        else
            root.problems().fail(Issue::gltf_structure, name, "must be a string");
    }
    return names;
}

/// Places of each extension, by its name.
using ExtensionPlaces = std::map<std::string, PlaceList, std::less<>>;

/// Add the objects that have extensions that are not read, at `path` and below. The JSON parser limits the
/// depth.
void findUnsupportedExtensions(const JsonPath& path, ExtensionPlaces& places)
{
    const Json& json = path.value;
    for (size_t i = 0; i < json.size(); ++i)
    {
        const JsonPath child{&path, json[i], i};
        if (json.isObject() && child.value.key() == "extras")
            continue;
        if (json.isObject() && child.value.key() == "extensions" && child.value.isObject())
            for (size_t k = 0; k < child.value.size(); ++k)
                if (const std::string_view name = child.value[k].key(); !isSupported(name))
                    places[std::string(name)].add(path);
        findUnsupportedExtensions(child, places);
    }
}

void checkExtensions(const GltfObject& root)
{
    for (const std::string& name : readNames(root, "extensionsRequired"))
        if (!isSupported(name))
            root.problems().fail(Issue::gltf_extension, *root.json().find("extensionsRequired"),
                                 fmt::format("the file requires {}, which is not supported", name));
    ExtensionPlaces places;
    for (const std::string& name : readNames(root, "extensionsUsed"))
        if (!isSupported(name))
            places.try_emplace(name);
    findUnsupportedExtensions({nullptr, root.json(), 0}, places);
    for (const auto& [name, objects] : places)
        root.problems().warn(Issue::dropped, objects.first(),
                             fmt::format("extension {} is not kept{}", name,
                                         objects.empty() ? ": extensionsUsed names it, but no object has it"
                                                         : objects.list()));
}

} // namespace

uint32_t drawnScene(const GltfModel& model)
{
    return model.scene == kInvalidIndex && !model.scenes.empty() ? 0 : model.scene;
}

Result<GltfModel> readGltfModel(const JsonDocument& document, const std::string& file, PartBuilder& part)
{
    GltfProblems problems(file, part);
    const GltfObject root(document.root(), problems);
    checkVersion(root);
    HEARTH_TRY(problems.status());
    checkExtensions(root);
    HEARTH_TRY(problems.status());

    GltfModel model;
    readBuffers(root, model);
    readBufferViews(root, model);
    readAccessors(root, model);
    readImages(root, model);
    readTextures(root, model);
    readMaterials(root, model);
    readMeshes(root, model);
    readCameras(root, model);
    readLights(root, model);
    readNodes(root, root.objects("skins").size(), model);
    readImageLights(root, model);
    readScenes(root, model);
    readSkins(root, model);
    readAnimations(root, model);
    HEARTH_TRY(problems.status());
    return model;
}

} // namespace hearth::import
