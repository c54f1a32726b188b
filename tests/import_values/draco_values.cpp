// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/draco_values.h"

#include <draco/compression/decode.h>

namespace hearth::test
{

namespace
{

/// Return glTF's number of a type; 0 for a type that glTF lacks.
int componentType(draco::DataType type)
{
    switch (type)
    {
    case draco::DT_INT8:
        return 5120;
    case draco::DT_UINT8:
        return 5121;
    case draco::DT_INT16:
        return 5122;
    case draco::DT_UINT16:
        return 5123;
    case draco::DT_FLOAT32:
        return 5126;
    default:
        return 0;
    }
}

template <typename T>
void appendStored(const draco::PointAttribute& attribute, draco::AttributeValueIndex value,
                  std::vector<double>& values)
{
    std::vector<T> stored(attribute.num_components());
    attribute.GetValue(value, stored.data());
    for (const T number : stored)
        values.push_back(static_cast<double>(number));
}

DracoAttribute readAttribute(const draco::Mesh& mesh, const draco::PointAttribute& source)
{
    DracoAttribute attribute;
    attribute.id = source.unique_id();
    attribute.component_type = componentType(source.data_type());
    attribute.components = source.num_components();
    for (uint32_t point = 0; attribute.component_type != 0 && point < mesh.num_points(); ++point)
    {
        const draco::AttributeValueIndex value = source.mapped_index(draco::PointIndex(point));
        switch (source.data_type())
        {
        case draco::DT_INT8:
            appendStored<int8_t>(source, value, attribute.values);
            break;
        case draco::DT_UINT8:
            appendStored<uint8_t>(source, value, attribute.values);
            break;
        case draco::DT_INT16:
            appendStored<int16_t>(source, value, attribute.values);
            break;
        case draco::DT_UINT16:
            appendStored<uint16_t>(source, value, attribute.values);
            break;
        default:
            appendStored<float>(source, value, attribute.values);
        }
    }
    return attribute;
}

} // namespace

DracoMesh decodeDraco(const std::vector<uint8_t>& bytes)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    DracoMesh result;
    if (!decoded.ok())
    {
        result.error = decoded.status().error_msg_string();
        return result;
    }
    const draco::Mesh& mesh = *decoded.value();
    for (uint32_t face = 0; face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(face)))
            result.indices.push_back(point.value());
    for (int32_t i = 0; i < mesh.num_attributes(); ++i)
        result.attributes.push_back(readAttribute(mesh, *mesh.attribute(i)));
    return result;
}

} // namespace hearth::test
