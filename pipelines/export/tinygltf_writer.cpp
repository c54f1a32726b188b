// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/tinygltf_writer.h"

#include "formats/base/atomic_file.h"

#include <fmt/format.h>

#include <fstream>
#include <ostream>
#include <streambuf>

// the library is used as a header: Debian's shared one clashes with that of Draco, and reads images
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <nlohmann/json.hpp>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Weverything"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace hearth::gltf_export
{

namespace
{

using nlohmann::json;
using tinygltf::Value;

// the sizes of a GLB and of its chunks are 32 bits; what is left is for headers and JSON
constexpr uint64_t kMaxBinary = 0xFFFFFFFF - (uint64_t{1} << 28);

int toIndex(uint32_t index)
{
    return index == kInvalidIndex ? -1 : static_cast<int>(index);
}

template <size_t N>
std::vector<double> toNumbers(const std::array<double, N>& values)
{
    return {values.begin(), values.end()};
}

template <typename Numbers>
Value toArray(const Numbers& numbers)
{
    Value::Array array;
    for (const auto number : numbers)
        array.emplace_back(number);
    return Value(std::move(array));
}

/// Stream buffer that passes all bytes on to a file.
class FileBuffer : public std::streambuf
{
public:
    explicit FileBuffer(AtomicFile& file) : file_(file) {}

protected:
    std::streamsize xsputn(const char* text, std::streamsize size) override
    {
        file_.write(std::string_view(text, static_cast<size_t>(size)));
        return size;
    }
    int_type overflow(int_type character) override
    {
        const char one = traits_type::to_char_type(character);
        xsputn(&one, 1);
        return character;
    }

private:
    AtomicFile& file_;
};

/// Builds tinygltf's model of a document.
class ModelBuilder
{
public:
    explicit ModelBuilder(const GltfDocument& document) : document_(document) {}

    tinygltf::Model build();

private:
    void useExtension(const std::string& name)
    {
        auto& used = model_.extensionsUsed;
        if (std::find(used.begin(), used.end(), name) == used.end())
            used.push_back(name);
    }
    template <typename Object>
    void addExtension(Object& object, const std::string& name, Value::Object properties)
    {
        useExtension(name);
        object.extensions[name] = Value(std::move(properties));
    }
    template <typename Info>
    void setTexture(Info& info, const TextureUse& use);
    void addTexture(Value::Object& object, const std::string& name, const TextureUse& use,
                    double normal_scale = 1);
    static Value::Object textureTransform(const TextureTransform& transform);
    void addLayers(const Material& material, tinygltf::Material& result);
    void addBinary();
    void addTextures();
    void addMaterials();
    void addMeshes();
    void addNodes();
    void addCamerasAndLights();
    void addMotion();

    const GltfDocument& document_;
    tinygltf::Model model_;
};

Value::Object ModelBuilder::textureTransform(const TextureTransform& transform)
{
    Value::Object object;
    object["offset"] = toArray(transform.offset);
    object["rotation"] = Value(transform.rotation);
    object["scale"] = toArray(transform.scale);
    return object;
}

template <typename Info>
void ModelBuilder::setTexture(Info& info, const TextureUse& use)
{
    info.index = toIndex(use.texture);
    info.texCoord = static_cast<int>(use.uv_set);
    if (use.transform)
        addExtension(info, "KHR_texture_transform", textureTransform(*use.transform));
}

/// Add a texture to the properties of an extension.
void ModelBuilder::addTexture(Value::Object& object, const std::string& name, const TextureUse& use,
                              double normal_scale)
{
    if (use.texture == kInvalidIndex)
        return;
    Value::Object info;
    info["index"] = Value(toIndex(use.texture));
    if (use.uv_set != 0)
        info["texCoord"] = Value(static_cast<int>(use.uv_set));
    if (normal_scale != 1)
        info["scale"] = Value(normal_scale);
    if (use.transform)
    {
        useExtension("KHR_texture_transform");
        Value::Object extensions;
        extensions["KHR_texture_transform"] = Value(textureTransform(*use.transform));
        info["extensions"] = Value(std::move(extensions));
    }
    object[name] = Value(std::move(info));
}

void ModelBuilder::addLayers(const Material& material, tinygltf::Material& result)
{
    if (material.emissive_strength != 1)
        addExtension(result, "KHR_materials_emissive_strength",
                     {{"emissiveStrength", Value(material.emissive_strength)}});
    if (material.is_unlit)
        addExtension(result, "KHR_materials_unlit", {});
    if (material.ior)
        addExtension(result, "KHR_materials_ior", {{"ior", Value(*material.ior)}});
    if (const auto& specular = material.specular)
    {
        Value::Object object{{"specularFactor", Value(specular->factor)},
                             {"specularColorFactor", toArray(specular->color)}};
        addTexture(object, "specularTexture", specular->texture);
        addTexture(object, "specularColorTexture", specular->color_texture);
        addExtension(result, "KHR_materials_specular", std::move(object));
    }
    if (const auto& clearcoat = material.clearcoat)
    {
        Value::Object object{{"clearcoatFactor", Value(clearcoat->factor)},
                             {"clearcoatRoughnessFactor", Value(clearcoat->roughness)}};
        addTexture(object, "clearcoatTexture", clearcoat->texture);
        addTexture(object, "clearcoatRoughnessTexture", clearcoat->roughness_texture);
        addTexture(object, "clearcoatNormalTexture", clearcoat->normal_texture, clearcoat->normal_scale);
        addExtension(result, "KHR_materials_clearcoat", std::move(object));
    }
    if (const auto& sheen = material.sheen)
    {
        Value::Object object{{"sheenColorFactor", toArray(sheen->color)},
                             {"sheenRoughnessFactor", Value(sheen->roughness)}};
        addTexture(object, "sheenColorTexture", sheen->color_texture);
        addTexture(object, "sheenRoughnessTexture", sheen->roughness_texture);
        addExtension(result, "KHR_materials_sheen", std::move(object));
    }
}

void ModelBuilder::addBinary()
{
    constexpr int kTypes[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                              TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_MAT4};
    for (const BufferView& view : document_.views)
    {
        tinygltf::BufferView result;
        result.buffer = 0;
        result.byteOffset = static_cast<size_t>(view.offset);
        result.byteLength = static_cast<size_t>(view.size);
        result.target = static_cast<int>(view.target);
        model_.bufferViews.push_back(std::move(result));
    }
    for (const Accessor& accessor : document_.accessors)
    {
        tinygltf::Accessor result;
        result.bufferView = toIndex(accessor.view);
        result.componentType = static_cast<int>(accessor.component);
        result.type = kTypes[static_cast<size_t>(accessor.type)];
        result.normalized = accessor.is_normalized;
        result.count = static_cast<size_t>(accessor.count);
        result.minValues = accessor.min;
        result.maxValues = accessor.max;
        model_.accessors.push_back(std::move(result));
    }
}

/// Add textures, and the samplers that differ.
void ModelBuilder::addTextures()
{
    for (const Texture& texture : document_.textures)
    {
        tinygltf::Sampler sampler;
        sampler.magFilter = texture.mag_filter;
        sampler.minFilter = texture.min_filter;
        sampler.wrapS = texture.wrap_s;
        sampler.wrapT = texture.wrap_t;
        auto found = std::find(model_.samplers.begin(), model_.samplers.end(), sampler);
        if (found == model_.samplers.end())
            found = model_.samplers.insert(found, sampler);
        tinygltf::Texture result;
        result.source = toIndex(texture.image);
        result.sampler = static_cast<int>(found - model_.samplers.begin());
        model_.textures.push_back(std::move(result));
    }
}

void ModelBuilder::addMaterials()
{
    for (const Material& material : document_.materials)
    {
        tinygltf::Material result;
        result.name = material.name;
        auto& surface = result.pbrMetallicRoughness;
        surface.baseColorFactor = toNumbers(material.base_color);
        surface.metallicFactor = material.metallic;
        surface.roughnessFactor = material.roughness;
        setTexture(surface.baseColorTexture, material.base_color_texture);
        setTexture(surface.metallicRoughnessTexture, material.metallic_roughness_texture);
        setTexture(result.normalTexture, material.normal_texture);
        result.normalTexture.scale = material.normal_scale;
        setTexture(result.occlusionTexture, material.occlusion_texture);
        result.occlusionTexture.strength = material.occlusion_strength;
        setTexture(result.emissiveTexture, material.emissive_texture);
        result.emissiveFactor = toNumbers(material.emissive);
        result.alphaMode = material.alpha_mode;
        result.alphaCutoff = material.alpha_cutoff;
        result.doubleSided = material.is_double_sided;
        addLayers(material, result);
        model_.materials.push_back(std::move(result));
    }
}

void ModelBuilder::addMeshes()
{
    const auto copyAttributes = [](const Attributes& from, std::map<std::string, int>& to)
    {
        for (const auto& [name, accessor] : from)
            to[name] = toIndex(accessor);
    };
    for (const Mesh& mesh : document_.meshes)
    {
        tinygltf::Mesh result;
        result.name = mesh.name;
        for (const Primitive& primitive : mesh.primitives)
        {
            tinygltf::Primitive part;
            part.mode = TINYGLTF_MODE_TRIANGLES;
            part.indices = toIndex(primitive.indices);
            part.material = toIndex(primitive.material);
            copyAttributes(primitive.attributes, part.attributes);
            for (const Attributes& target : primitive.targets)
                copyAttributes(target, part.targets.emplace_back());
            result.primitives.push_back(std::move(part));
        }
        model_.meshes.push_back(std::move(result));
    }
}

void ModelBuilder::addNodes()
{
    for (const Node& node : document_.nodes)
    {
        tinygltf::Node result;
        result.name = node.name;
        result.mesh = toIndex(node.mesh);
        result.skin = toIndex(node.skin);
        result.camera = toIndex(node.camera);
        result.children.assign(node.children.begin(), node.children.end());
        result.weights = node.weights;
        if (node.matrix)
            result.matrix = toNumbers(*node.matrix);
        if (node.translation != Node{}.translation)
            result.translation = toNumbers(node.translation);
        if (node.rotation != Node{}.rotation)
            result.rotation = toNumbers(node.rotation);
        if (node.scale != Node{}.scale)
            result.scale = toNumbers(node.scale);
        if (node.light != kInvalidIndex)
            addExtension(result, "KHR_lights_punctual", {{"light", Value(toIndex(node.light))}});
        if (!node.lods.empty())
        {
            const std::vector<int> ids(node.lods.begin(), node.lods.end());
            addExtension(result, "MSFT_lod", {{"ids", toArray(ids)}});
        }
        model_.nodes.push_back(std::move(result));
    }
    tinygltf::Scene scene;
    scene.nodes.assign(document_.scene_nodes.begin(), document_.scene_nodes.end());
    model_.scenes.push_back(std::move(scene));
    model_.defaultScene = 0;
}

void ModelBuilder::addCamerasAndLights()
{
    for (const Camera& camera : document_.cameras)
    {
        tinygltf::Camera result;
        result.name = camera.name;
        result.type = camera.is_orthographic ? "orthographic" : "perspective";
        result.perspective.yfov = camera.y_fov;
        result.perspective.aspectRatio = camera.aspect;
        result.perspective.znear = result.orthographic.znear = camera.z_near;
        result.perspective.zfar = result.orthographic.zfar = camera.z_far;
        result.orthographic.xmag = camera.x_magnification;
        result.orthographic.ymag = camera.y_magnification;
        model_.cameras.push_back(std::move(result));
    }
    for (const Light& light : document_.lights)
    {
        tinygltf::Light result;
        result.name = light.name;
        result.type = light.type;
        result.color = toNumbers(light.color);
        result.intensity = light.intensity;
        result.range = light.range;
        result.spot.innerConeAngle = light.inner_cone;
        result.spot.outerConeAngle = light.outer_cone;
        model_.lights.push_back(std::move(result));
    }
}

void ModelBuilder::addMotion()
{
    for (const Skin& skin : document_.skins)
    {
        tinygltf::Skin result;
        result.name = skin.name;
        result.joints.assign(skin.joints.begin(), skin.joints.end());
        result.inverseBindMatrices = toIndex(skin.inverse_bind_matrices);
        result.skeleton = toIndex(skin.skeleton);
        model_.skins.push_back(std::move(result));
    }
    for (const Animation& animation : document_.animations)
    {
        tinygltf::Animation result;
        result.name = animation.name;
        for (const AnimationChannel& channel : animation.channels)
        {
            tinygltf::AnimationSampler sampler;
            sampler.input = toIndex(channel.input);
            sampler.output = toIndex(channel.output);
            sampler.interpolation = channel.interpolation;
            tinygltf::AnimationChannel target;
            target.sampler = static_cast<int>(result.samplers.size());
            target.target_node = toIndex(channel.node);
            target.target_path = channel.path;
            if (channel.node == kInvalidIndex)
            {
                useExtension("KHR_animation_pointer");
                target.target_path = "pointer";
                target.target_extensions["KHR_animation_pointer"] =
                    Value(Value::Object{{"pointer", Value(channel.path)}});
            }
            result.samplers.push_back(std::move(sampler));
            result.channels.push_back(std::move(target));
        }
        model_.animations.push_back(std::move(result));
    }
}

tinygltf::Model ModelBuilder::build()
{
    model_.asset.version = "2.0";
    model_.asset.generator = document_.generator;
    addBinary();
    addTextures();
    addMaterials();
    addMeshes();
    addNodes();
    addCamerasAndLights();
    addMotion();
    std::sort(model_.extensionsUsed.begin(), model_.extensionsUsed.end());
    return std::move(model_);
}

/// Correct what tinygltf 2.7 writes of objects without properties, cameras without a far plane, and
/// channels without a node.
void repairJson(json& root)
{
    for (const char* array : {"nodes", "scenes"})
        if (const auto found = root.find(array); found != root.end())
            for (json& object : *found)
                if (object.is_null())
                    object = json::object();
    if (const auto cameras = root.find("cameras"); cameras != root.end())
        for (json& camera : *cameras)
            if (const auto perspective = camera.find("perspective");
                perspective != camera.end() && (*perspective)["zfar"] == 0)
                perspective->erase("zfar");
    if (const auto animations = root.find("animations"); animations != root.end())
        for (json& animation : *animations)
            for (json& channel : animation["channels"])
                if (channel["target"]["node"] == -1)
                    channel["target"].erase("node");
}

json makeJson(const GltfDocument& document)
{
    json root;
    tinygltf::Model model = ModelBuilder(document).build();
    tinygltf::SerializeGltfModel(&model, root);
    for (const Image& image : document.images)
    {
        tinygltf::Image result;
        result.name = image.name;
        result.mimeType = "image/png";
        result.bufferView = toIndex(image.view);
        json object;
        tinygltf::SerializeGltfImage(result, "", object);
        root["images"].push_back(std::move(object));
    }
    if (!document.binary.empty())
        root["buffers"] = json::array({json{{"byteLength", document.binary.size()}}});
    repairJson(root);
    for (const Extras& extras : document.extras)
        root[json::json_pointer(extras.owner)]["extras"] = json::parse(extras.json);
    return root;
}

} // namespace

Status writeGlb(const GltfDocument& document, const std::string& path)
{
    if (document.binary.size() > kMaxBinary)
        return Error{
            Issue::cannot_write, path, "",
            fmt::format("vertices and textures have {} bytes, a GLB can have {}; write one mesh with "
                        "--mesh, or fewer triangles with --error",
                        document.binary.size(), kMaxBinary)};
    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(path));
    try
    {
        FileBuffer buffer(file);
        std::ostream stream(&buffer);
        tinygltf::WriteBinaryGltfStream(stream, makeJson(document).dump(), document.binary);
    }
    catch (const json::exception& problem)
    {
        return Error{Issue::cannot_write, path, "",
                     fmt::format("the pack has a text that JSON cannot hold: {}", problem.what())};
    }
    return file.finish();
}

} // namespace hearth::gltf_export
