// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/draco.h"

#include "pipelines/import/source/draco_counts.h"

#include <draco/compression/decode.h>

#include <fmt/format.h>

#include <exception>
#include <limits>

namespace hearth::import
{

namespace
{

float normalizedInteger(int64_t value, draco::DataType type)
{
    const auto divided = [&](double max)
    { return std::max(static_cast<float>(static_cast<double>(value) / max), -1.0f); };
    switch (type)
    {
    case draco::DT_INT8:
        return divided(std::numeric_limits<int8_t>::max());
    case draco::DT_UINT8:
        return divided(std::numeric_limits<uint8_t>::max());
    case draco::DT_INT16:
        return divided(std::numeric_limits<int16_t>::max());
    case draco::DT_UINT16:
        return divided(std::numeric_limits<uint16_t>::max());
    case draco::DT_INT32:
        return divided(std::numeric_limits<int32_t>::max());
    case draco::DT_UINT32:
        return divided(std::numeric_limits<uint32_t>::max());
    default:
        return static_cast<float>(value);
    }
}

/// Return all values of one attribute; nullopt if the decoded data do not hold them.
std::optional<std::vector<float>> readAttribute(const draco::Mesh& mesh, const draco::PointAttribute& source,
                                                const DracoAttribute& wanted)
{
    const auto count = static_cast<int8_t>(wanted.component_count);
    const bool is_float = source.data_type() == draco::DT_FLOAT32 || source.data_type() == draco::DT_FLOAT64;
    std::vector<float> values(size_t{mesh.num_points()} * wanted.component_count);
    std::array<int64_t, 4> integers{};
    for (uint32_t point = 0; point < mesh.num_points(); ++point)
    {
        float* out = values.data() + size_t{point} * wanted.component_count;
        const draco::AttributeValueIndex value = source.mapped_index(draco::PointIndex(point));
        if (is_float)
        {
            if (!source.ConvertValue<float>(value, count, out))
                return std::nullopt;
            continue;
        }
        if (!source.ConvertValue<int64_t>(value, count, integers.data()))
            return std::nullopt;
        for (uint32_t c = 0; c < wanted.component_count; ++c)
            out[c] = wanted.normalized ? normalizedInteger(integers[c], source.data_type())
                                       : static_cast<float>(integers[c]);
    }
    return values;
}

/// Decode into `result`. Return a description of the damage, or nullopt on success.
std::optional<std::string> decode(std::span<const std::byte> compressed,
                                  std::span<const DracoAttribute> attributes, DracoMesh& result)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        return decoded.status().error_msg_string();
    const draco::Mesh& mesh = *decoded.value();

    result.vertex_count = mesh.num_points();
    result.indices.reserve(size_t{mesh.num_faces()} * 3);
    for (uint32_t face = 0; face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(face)))
        {
            if (point.value() >= mesh.num_points())
                return fmt::format("index {} of {} vertices", point.value(), mesh.num_points());
            result.indices.push_back(point.value());
        }
    for (const DracoAttribute& wanted : attributes)
    {
        const draco::PointAttribute* source = mesh.GetAttributeByUniqueId(wanted.id);
        if (source == nullptr || source->num_components() < static_cast<int>(wanted.component_count))
            return fmt::format("there is no attribute {} with {} components", wanted.id,
                               wanted.component_count);
        std::optional<std::vector<float>> values = readAttribute(mesh, *source, wanted);
        if (!values)
            return fmt::format("the values of attribute {} are damaged", wanted.id);
        result.attributes.push_back(std::move(*values));
    }
    return std::nullopt;
}

} // namespace

Result<DracoMesh> decodeDraco(std::span<const std::byte> compressed,
                              std::span<const DracoAttribute> attributes, const std::string& file,
                              const std::string& where)
{
    const auto failure = [&](const std::string& reason) {
        return Error{Issue::codec_failed, file, where, "Draco: " + reason};
    };
    try
    {
        if (const std::optional<std::string> reason = findImpossibleDracoCount(compressed))
            return failure(*reason);
        DracoMesh mesh;
        if (const std::optional<std::string> reason = decode(compressed, attributes, mesh))
            return failure(*reason);
        return mesh;
    }
    catch (const std::exception& exception) // damaged counts make the library ask for too much memory
    {
        return failure(exception.what());
    }
}

} // namespace hearth::import
