// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/source_model.h"

#include "cook/json/json.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <meshoptimizer.h>

namespace hearth::test
{

namespace
{

constexpr const char* kMeshopt = "EXT_meshopt_compression";

std::string readBytes(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Remove from the text of a file what tinygltf refuses. Fallback buffers of meshopt get one byte: their
/// views are decoded from another buffer. Indices of Draco primitives go: they have no bytes but Draco's.
std::string readableText(const std::string& text, bool has_chunk)
{
    Json json = Json::parse(text).value();
    const Json* buffers = json.find("buffers");
    for (size_t i = 0; buffers != nullptr && i < buffers->size(); ++i)
    {
        Json& buffer = json["buffers"][i];
        if (buffer.contains("uri") || (has_chunk && i == 0))
            continue;
        buffer["uri"] = "data:application/octet-stream;base64,AA==";
        buffer["byteLength"] = 1;
    }
    const Json* meshes = json.find("meshes");
    for (size_t i = 0; meshes != nullptr && i < meshes->size(); ++i)
        for (Json& primitive : json["meshes"][i]["primitives"])
            if (primitive.resolve("/extensions/KHR_draco_mesh_compression") != nullptr)
                primitive.erase("indices");
    return json.dump();
}

void appendNumber(std::string& bytes, size_t number)
{
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char>((number >> (8 * i)) & 255u);
}

size_t readNumber(const std::string& bytes, size_t at)
{
    size_t number = 0;
    for (size_t i = 0; i < 4; ++i)
        number |= size_t{static_cast<uint8_t>(bytes.at(at + i))} << (8 * i);
    return number;
}

/// Return a GLB with another JSON text.
std::string withJson(const std::string& glb, std::string json)
{
    const size_t json_size = readNumber(glb, 12);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string result = glb.substr(0, 8);
    const std::string rest = glb.substr(20 + json_size);
    appendNumber(result, 20 + json.size() + rest.size());
    appendNumber(result, json.size());
    return result + glb.substr(16, 4) + json + rest;
}

bool keepImage(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
               void*)
{
    return true;
}

bool load(const std::string& path, tinygltf::Model& model, std::string& error)
{
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keepImage, nullptr);
    std::string warning;
    const std::string bytes = readBytes(path);
    const std::string folder = path.substr(0, path.rfind('/'));
    if (bytes.starts_with("glTF"))
    {
        const std::string json = bytes.substr(20, readNumber(bytes, 12));
        const std::string glb = withJson(bytes, readableText(json, true));
        return loader.LoadBinaryFromMemory(&model, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(glb.data()),
                                           static_cast<unsigned>(glb.size()), folder);
    }
    const std::string json = readableText(bytes, false);
    return loader.LoadASCIIFromString(&model, &error, &warning, json.data(),
                                      static_cast<unsigned>(json.size()), folder);
}

std::vector<uint8_t> decodeMeshopt(const tinygltf::Model& model, const tinygltf::Value& how)
{
    const auto number = [&](const char* key)
    { return how.Has(key) ? static_cast<size_t>(how.Get(key).GetNumberAsInt()) : size_t{0}; };
    const auto word = [&](const char* key)
    { return how.Has(key) ? how.Get(key).Get<std::string>() : std::string("NONE"); };
    const size_t count = number("count"), stride = number("byteStride"), size = number("byteLength");
    const uint8_t* from = model.buffers.at(number("buffer")).data.data() + number("byteOffset");
    std::vector<uint8_t> decoded(count * stride);
    int failed = 1;
    if (word("mode") == "ATTRIBUTES")
        failed = meshopt_decodeVertexBuffer(decoded.data(), count, stride, from, size);
    else if (word("mode") == "TRIANGLES")
        failed = meshopt_decodeIndexBuffer(decoded.data(), count, stride, from, size);
    else if (word("mode") == "INDICES")
        failed = meshopt_decodeIndexSequence(decoded.data(), count, stride, from, size);
    if (failed != 0)
        return {};
    if (word("filter") == "OCTAHEDRAL")
        meshopt_decodeFilterOct(decoded.data(), count, stride);
    else if (word("filter") == "QUATERNION")
        meshopt_decodeFilterQuat(decoded.data(), count, stride);
    else if (word("filter") == "EXPONENTIAL")
        meshopt_decodeFilterExp(decoded.data(), count, stride);
    return decoded;
}

std::vector<uint8_t> readView(const tinygltf::Model& model, const tinygltf::BufferView& view)
{
    if (const auto found = view.extensions.find(kMeshopt); found != view.extensions.end())
        return decodeMeshopt(model, found->second);
    const std::vector<unsigned char>& bytes = model.buffers.at(static_cast<size_t>(view.buffer)).data;
    if (view.byteOffset + view.byteLength > bytes.size())
        return {};
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
    return {first, first + static_cast<std::ptrdiff_t>(view.byteLength)};
}

size_t componentBytes(int type)
{
    return type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE     ? 1
           : type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
                                                                                                     : 4;
}

double readComponent(const std::vector<uint8_t>& bytes, size_t at, int type)
{
    const auto read = [&]<typename T>(T value)
    {
        static_cast<void>(bytes.at(at + sizeof(T) - 1));
        std::memcpy(&value, bytes.data() + at, sizeof(T));
        return static_cast<double>(value);
    };
    switch (type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return read(int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return read(uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return read(int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return read(uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return read(uint32_t{});
    default:
        return read(float{});
    }
}

} // namespace

double normalised(double value, int type)
{
    switch (type)
    {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::max(value / 127, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return value / 255;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return std::max(value / 32767, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return value / 65535;
    default:
        return value;
    }
}

SourceModel readSourceModel(const std::string& path)
{
    SourceModel source;
    if (!load(path, source.model, source.error))
    {
        source.error = "tinygltf does not read it: " + source.error;
        return source;
    }
    source.error.clear(); // of channels without a node, which it leaves out
    for (const tinygltf::BufferView& view : source.model.bufferViews)
        source.views.push_back(readView(source.model, view));
    return source;
}

SourceValues readValues(const SourceModel& source, int index)
{
    const tinygltf::Accessor& accessor = source.model.accessors.at(static_cast<size_t>(index));
    const int type = accessor.componentType;
    SourceValues values;
    values.components =
        static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
    values.is_exact = type == TINYGLTF_COMPONENT_TYPE_FLOAT || !accessor.normalized;
    values.values.assign(accessor.count * values.components, 0.0);
    const size_t size = componentBytes(type);
    const auto readElement = [&](size_t element, const std::vector<uint8_t>& bytes, size_t at)
    {
        for (size_t i = 0; i < values.components; ++i)
        {
            const double raw = readComponent(bytes, at + i * size, type);
            values.values[element * values.components + i] =
                accessor.normalized ? normalised(raw, type) : raw;
        }
    };
    if (accessor.bufferView >= 0)
    {
        const auto view = static_cast<size_t>(accessor.bufferView);
        const size_t given = source.model.bufferViews.at(view).byteStride;
        const size_t stride = given == 0 ? size * values.components : given;
        for (size_t i = 0; i < accessor.count; ++i)
            readElement(i, source.views.at(view), accessor.byteOffset + i * stride);
    }
    if (accessor.sparse.isSparse)
        for (size_t i = 0; i < static_cast<size_t>(accessor.sparse.count); ++i)
        {
            const auto& indices = accessor.sparse.indices;
            const auto& replaced = accessor.sparse.values;
            const double element = readComponent(source.views.at(static_cast<size_t>(indices.bufferView)),
                                                 static_cast<size_t>(indices.byteOffset) +
                                                     i * componentBytes(indices.componentType),
                                                 indices.componentType);
            readElement(static_cast<size_t>(element),
                        source.views.at(static_cast<size_t>(replaced.bufferView)),
                        static_cast<size_t>(replaced.byteOffset) + i * size * values.components);
        }
    return values;
}

SourceTransform operator*(const SourceTransform& a, const SourceTransform& b)
{
    SourceTransform product;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
        {
            product.m[row][column] = column == 3 ? a.m[row][3] : 0.0;
            for (int k = 0; k < 3; ++k)
                product.m[row][column] += a.m[row][k] * b.m[k][column];
        }
    return product;
}

SourceTransform fromTrs(const double* t, const double* r, const double* s)
{
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    const double x = r[0] / length, y = r[1] / length, z = r[2] / length, w = r[3] / length;
    return {
        {{(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - w * z) * s[1], 2 * (x * z + w * y) * s[2], t[0]},
         {2 * (x * y + w * z) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - w * x) * s[2], t[1]},
         {2 * (x * z - w * y) * s[0], 2 * (y * z + w * x) * s[1], (1 - 2 * (x * x + y * y)) * s[2], t[2]}}};
}

SourceTransform fromColumns(const double* columns)
{
    SourceTransform transform;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            transform.m[row][column] = columns[column * 4 + row];
    return transform;
}

SourceTransform nodeTransform(const tinygltf::Node& node)
{
    constexpr double kZero[3] = {0, 0, 0}, kNoTurn[4] = {0, 0, 0, 1}, kOne[3] = {1, 1, 1};
    if (!node.matrix.empty())
        return fromColumns(node.matrix.data());
    return fromTrs(node.translation.empty() ? kZero : node.translation.data(),
                   node.rotation.empty() ? kNoTurn : node.rotation.data(),
                   node.scale.empty() ? kOne : node.scale.data());
}

} // namespace hearth::test
