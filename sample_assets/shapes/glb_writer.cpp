// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/glb_writer.h"

#include "sample_assets/shapes/glb_animations.h"
#include "sample_assets/shapes/parallel.h"
#include "sample_assets/shapes/png.h"

#include <cstdio>
#include <cstring>

namespace hearth::samples
{

namespace
{

constexpr int kComponentU16 = 5123, kComponentU32 = 5125;
constexpr int kTargetVertices = 34962, kTargetIndices = 34963;

Json toJson(Float2 v)
{
    return Json::array({v.x, v.y});
}
Json toJson(Float3 v)
{
    return Json::array({v.x, v.y, v.z});
}
Json toJson(Float4 v)
{
    return Json::array({v.x, v.y, v.z, v.w});
}

int addPositions(Glb& glb, std::span<const Float3> positions)
{
    Box3 box;
    for (const Float3 p : positions)
        box.add(p);
    return glb.addAccessor(positions, kComponentF32, "VEC3", kTargetVertices,
                           Json{{"min", toJson(box.min)}, {"max", toJson(box.max)}});
}

int addIndices(Glb& glb, const TriangleMesh& mesh)
{
    if (mesh.positions.size() > 0xFFFF)
        return glb.addAccessor<uint32_t>(mesh.indices, kComponentU32, "SCALAR", kTargetIndices);
    const std::vector<uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
    return glb.addAccessor<uint16_t>(narrow, kComponentU16, "SCALAR", kTargetIndices);
}

Json primitiveJson(Glb& glb, const Primitive& primitive)
{
    const TriangleMesh& mesh = primitive.mesh;
    Json attributes{{"POSITION", addPositions(glb, mesh.positions)}};
    const auto attribute =
        [&]<typename T>(const char* name, const std::vector<T>& values, int component, const char* type)
    {
        HEARTH_ASSERT(values.empty() || values.size() == mesh.positions.size());
        if (!values.empty())
            attributes[name] = glb.addAccessor<T>(values, component, type, kTargetVertices);
    };
    attribute("NORMAL", mesh.normals, kComponentF32, "VEC3");
    attribute("TEXCOORD_0", mesh.uvs, kComponentF32, "VEC2");
    attribute("COLOR_0", mesh.colors, kComponentF32, "VEC4");
    attribute("JOINTS_0", mesh.joints, kComponentU16, "VEC4");
    attribute("WEIGHTS_0", mesh.weights, kComponentF32, "VEC4");
    Json json{{"attributes", std::move(attributes)}, {"indices", addIndices(glb, mesh)}};
    if (primitive.material != kNoIndex)
        json["material"] = primitive.material;
    return json;
}

void addMeshes(Glb& glb, const Document& document)
{
    for (const Mesh& mesh : document.meshes)
    {
        Json primitives = Json::array();
        for (const Primitive& primitive : mesh.primitives)
            primitives.push_back(primitiveJson(glb, primitive));
        glb.json["meshes"].push_back({{"name", mesh.name}, {"primitives", std::move(primitives)}});
    }
}

void addImages(Glb& glb, const Document& document)
{
    if (document.images.empty())
        return;
    std::vector<std::vector<std::byte>> files(document.images.size());
    parallelFor(files.size(), [&](size_t i) { files[i] = encodePng(document.images[i]); });
    constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kRepeat = 10497;
    glb.json["samplers"].push_back(
        {{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}});
    for (size_t i = 0; i < files.size(); ++i)
    {
        glb.json["images"].push_back({{"name", document.images[i].name},
                                      {"mimeType", "image/png"},
                                      {"bufferView", glb.addView(files[i])}});
        glb.json["textures"].push_back({{"sampler", 0}, {"source", i}});
    }
}

Json materialJson(Glb& glb, const Material& material)
{
    Json pbr{{"baseColorFactor", toJson(material.base_color)},
             {"metallicFactor", material.metallic},
             {"roughnessFactor", material.roughness}};
    if (material.base_color_image != kNoIndex)
        pbr["baseColorTexture"] = {{"index", material.base_color_image}};
    if (material.metallic_roughness_image != kNoIndex)
        pbr["metallicRoughnessTexture"] = {{"index", material.metallic_roughness_image}};

    Json json{{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    if (material.normal_image != kNoIndex)
    {
        json["normalTexture"] = {{"index", material.normal_image}, {"scale", material.normal_scale}};
        if (material.detail_scale != 1)
            glb.use(json["normalTexture"], "KHR_texture_transform",
                    {{"scale", toJson(Float2{material.detail_scale, material.detail_scale})}});
    }
    if (material.has_occlusion)
        json["occlusionTexture"] = {{"index", material.metallic_roughness_image}};
    if (material.emissive_image != kNoIndex)
        json["emissiveTexture"] = {{"index", material.emissive_image}};
    if (material.emissive != Float3{0, 0, 0})
        json["emissiveFactor"] = toJson(material.emissive);
    if (material.emissive_strength != 1)
        glb.use(json, "KHR_materials_emissive_strength", {{"emissiveStrength", material.emissive_strength}});
    if (material.unlit)
        glb.use(json, "KHR_materials_unlit", Json::object());
    if (material.alpha_cutoff > 0)
    {
        json["alphaMode"] = "MASK";
        json["alphaCutoff"] = material.alpha_cutoff;
    }
    if (material.double_sided)
        json["doubleSided"] = true;
    return json;
}

void addCameras(Glb& glb, const Document& document)
{
    for (const Camera& camera : document.cameras)
    {
        Json perspective{{"yfov", camera.y_fov_rad}, {"znear", camera.z_near}};
        if (camera.z_far > 0)
            perspective["zfar"] = camera.z_far;
        glb.json["cameras"].push_back(
            {{"name", camera.name}, {"type", "perspective"}, {"perspective", std::move(perspective)}});
    }
}

void addLights(Glb& glb, const Document& document)
{
    if (document.lights.empty())
        return;
    Json lights = Json::array();
    for (const Light& light : document.lights)
    {
        constexpr const char* kNames[] = {"directional", "point", "spot"};
        Json json{{"name", light.name},
                  {"type", kNames[static_cast<int>(light.kind)]},
                  {"color", toJson(light.color)},
                  {"intensity", light.intensity}};
        if (light.range > 0)
            json["range"] = light.range;
        if (light.kind == LightKind::spot)
            json["spot"] = {{"innerConeAngle", light.inner_cone_rad},
                            {"outerConeAngle", light.outer_cone_rad}};
        if (light.flicker.amplitude > 0)
            json["extras"]["flicker"] = {{"rate", light.flicker.rate},
                                         {"amplitude", light.flicker.amplitude},
                                         {"seed", light.flicker.seed}};
        lights.push_back(std::move(json));
    }
    glb.use(glb.json, "KHR_lights_punctual", {{"lights", std::move(lights)}});
}

/// Return the EXT_mesh_gpu_instancing object: one accessor each for translations, rotations and scales.
Json instancingJson(Glb& glb, std::span<const Placement> instances)
{
    std::vector<Float3> translations, scales;
    std::vector<Float4> rotations;
    for (const Placement& instance : instances)
    {
        translations.push_back(instance.translation);
        rotations.push_back(instance.rotation);
        scales.push_back(instance.scale);
    }
    return {{"attributes",
             {{"TRANSLATION", glb.addAccessor<Float3>(translations, kComponentF32, "VEC3", 0)},
              {"ROTATION", glb.addAccessor<Float4>(rotations, kComponentF32, "VEC4", 0)},
              {"SCALE", glb.addAccessor<Float3>(scales, kComponentF32, "VEC3", 0)}}}};
}

void addNodes(Glb& glb, const Document& document)
{
    for (const Node& node : document.nodes)
    {
        Json json{{"name", node.name}};
        if (node.placement.translation != Float3{0, 0, 0})
            json["translation"] = toJson(node.placement.translation);
        if (node.placement.rotation != Float4{0, 0, 0, 1})
            json["rotation"] = toJson(node.placement.rotation);
        if (node.placement.scale != Float3{1, 1, 1})
            json["scale"] = toJson(node.placement.scale);
        if (!node.children.empty())
            json["children"] = node.children;
        for (const auto& [name, index] :
             {std::pair("mesh", node.mesh), {"skin", node.skin}, {"camera", node.camera}})
            if (index != kNoIndex)
                json[name] = index;
        if (node.light != kNoIndex)
            glb.use(json, "KHR_lights_punctual", {{"light", node.light}});
        if (!node.instances.empty())
            glb.use(json, "EXT_mesh_gpu_instancing", instancingJson(glb, node.instances));
        glb.json["nodes"].push_back(std::move(json));
    }
}

void addSkins(Glb& glb, const Document& document)
{
    for (const Skin& skin : document.skins)
    {
        HEARTH_ASSERT(skin.joints.size() == skin.joint_from_bind.size());
        std::vector<std::array<float, 16>> matrices; // glTF stores columns
        for (const Affine3& bind : skin.joint_from_bind)
        {
            std::array<float, 16> columns{};
            for (size_t row = 0; row < 3; ++row)
                for (size_t column = 0; column < 4; ++column)
                    columns[column * 4 + row] = bind.m[row][column];
            columns[15] = 1;
            matrices.push_back(columns);
        }
        Json json{{"name", skin.name},
                  {"joints", skin.joints},
                  {"inverseBindMatrices",
                   glb.addAccessor<std::array<float, 16>>(matrices, kComponentF32, "MAT4", 0)}};
        if (skin.skeleton_root != kNoIndex)
            json["skeleton"] = skin.skeleton_root;
        glb.json["skins"].push_back(std::move(json));
    }
}

void appendWord(std::vector<std::byte>& bytes, size_t value)
{
    const auto word = static_cast<uint32_t>(value);
    std::byte raw[4];
    std::memcpy(raw, &word, sizeof(raw));
    bytes.insert(bytes.end(), raw, raw + 4);
}

/// Assemble a file: header, JSON chunk padded with spaces, binary chunk padded with zeros (glTF 2.0, section
/// 4.4).
GlbFile assemble(std::string text, std::vector<std::byte> binary)
{
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
    HEARTH_ASSERT(28 + text.size() + binary.size() <= UINT32_MAX);
    std::vector<std::byte> file;
    for (const size_t word :
         {size_t{kMagic}, size_t{2}, 28 + text.size() + binary.size(), text.size(), size_t{kJsonChunk}})
        appendWord(file, word);
    const auto text_bytes = std::as_bytes(std::span(text));
    file.insert(file.end(), text_bytes.begin(), text_bytes.end());
    appendWord(file, binary.size());
    appendWord(file, kBinaryChunk);
    return {std::move(file), std::move(binary)};
}

/// Return an upper bound of the meshes' size in the binary chunk, to reserve it once: growth by doubling
/// would copy gigabytes.
size_t meshBytes(const Document& document)
{
    constexpr size_t kPadding = 4, kArrays = 7;
    size_t bytes = 0;
    for (const Mesh& mesh : document.meshes)
        for (const Primitive& primitive : mesh.primitives)
        {
            const TriangleMesh& m = primitive.mesh;
            bytes += m.positions.size() * sizeof(Float3) + m.normals.size() * sizeof(Float3) +
                     m.uvs.size() * sizeof(Float2) + m.colors.size() * sizeof(Float4) +
                     m.joints.size() * sizeof(m.joints[0]) + m.weights.size() * sizeof(Float4) +
                     m.indices.size() * sizeof(uint32_t) + kArrays * kPadding;
        }
    return bytes;
}

} // namespace

GlbFile encodeGlb(const Document& document)
{
    Glb glb;
    glb.binary.reserve(meshBytes(document));
    glb.json["asset"] = {{"version", "2.0"}, {"generator", "hearth-samples"}};
    glb.json["scene"] = 0;
    glb.json["scenes"] = Json::array({Json{{"nodes", document.roots}}});
    addNodes(glb, document);
    addMeshes(glb, document);
    for (const Material& material : document.materials)
        glb.json["materials"].push_back(materialJson(glb, material));
    addImages(glb, document);
    addCameras(glb, document);
    addLights(glb, document);
    addSkins(glb, document);
    addAnimations(glb, document);
    glb.json["buffers"].push_back({{"byteLength", (glb.binary.size() + 3) / 4 * 4}});
    if (!glb.extensions.empty())
        glb.json["extensionsUsed"] = glb.extensions;
    return assemble(glb.json.dump(), std::move(glb.binary));
}

Status writeFile(const std::string& path, const GlbFile& glb)
{
    const std::string temporary = path + ".tmp";
    const auto fail = [&](const char* what)
    {
        std::remove(temporary.c_str());
        return Error{Issue::cannot_write, path, "", std::string(what) + ": " + std::strerror(errno)};
    };
    std::FILE* const file = std::fopen(temporary.c_str(), "wb");
    if (file == nullptr)
        return fail("cannot create the file");
    const auto write = [&](const std::vector<std::byte>& bytes)
    { return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size(); };
    const bool written = write(glb.head) && write(glb.binary);
    if (std::fclose(file) != 0 || !written)
        return fail("cannot write the file");
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
        return fail("cannot put the file in its place");
    return success();
}

} // namespace hearth::samples
