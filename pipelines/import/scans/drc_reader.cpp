// Reads bare Draco files (.drc): meshes and point clouds.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/scan_polygons.h"
#include "pipelines/import/source/draco_counts.h"

#include <draco/compression/decode.h>

#include <exception>
#include <limits>

namespace hearth::import
{

namespace
{

/// Read the values of an attribute for every point. Return false if the data is damaged.
template <typename T, int8_t kComponents, typename Convert>
bool readAttribute(const draco::PointCloud& cloud, const draco::PointAttribute& attribute,
                   std::vector<T>& out, Convert convert)
{
    out.reserve(cloud.num_points());
    for (uint32_t point = 0; point < cloud.num_points(); ++point)
    {
        std::array<float, size_t{kComponents}> values{};
        if (!attribute.ConvertValue<float>(attribute.mapped_index(draco::PointIndex(point)), kComponents,
                                           values.data()))
            return false;
        out.push_back(convert(values));
    }
    return true;
}

/// Return the factor that scales integer colours to 0..1; Draco scales attributes marked as normalized
/// itself.
float colorScale(const draco::PointAttribute& attribute)
{
    if (attribute.normalized())
        return 1;
    switch (attribute.data_type())
    {
    case draco::DT_UINT8:
        return 1.0f / std::numeric_limits<uint8_t>::max();
    case draco::DT_UINT16:
        return 1.0f / std::numeric_limits<uint16_t>::max();
    default:
        return 1.0f;
    }
}

bool readPositions(const draco::PointCloud& cloud, ScanPolygons& file)
{
    const draco::PointAttribute* attribute = cloud.GetNamedAttribute(draco::GeometryAttribute::POSITION);
    const auto convert = [](const std::array<float, 3>& v) { return Float3{v[0], v[1], v[2]}; };
    return attribute != nullptr && attribute->num_components() == 3 &&
           readAttribute<Float3, 3>(cloud, *attribute, file.positions, convert) &&
           std::all_of(file.positions.begin(), file.positions.end(), isFinite);
}

bool readOthers(const draco::PointCloud& cloud, ScanPolygons& file)
{
    if (const auto* normals = cloud.GetNamedAttribute(draco::GeometryAttribute::NORMAL))
        if (!readAttribute<Float3, 3>(cloud, *normals, file.normals,
                                      [](const std::array<float, 3>& v) {
                                          return Float3{v[0], v[1], v[2]};
                                      }))
            return false;
    if (const auto* uvs = cloud.GetNamedAttribute(draco::GeometryAttribute::TEX_COORD))
        if (!readAttribute<Float2, 2>(
                cloud, *uvs, file.uvs,
                [](const std::array<float, 2>& v) {
                    return std::isfinite(v[0]) && std::isfinite(v[1]) ? Float2{v[0], 1 - v[1]} : Float2{};
                }))
            return false;
    if (const auto* colors = cloud.GetNamedAttribute(draco::GeometryAttribute::COLOR))
    {
        const float scale = colorScale(*colors);
        const bool alpha = colors->num_components() > 3;
        return readAttribute<Float4, 4>(
            cloud, *colors, file.colors,
            [&](const std::array<float, 4>& v)
            { return linearColor(v[0] * scale, v[1] * scale, v[2] * scale, alpha ? v[3] * scale : 1); });
    }
    return true;
}

/// Decode into `file`. Return a description of the damage; empty on success.
std::string decode(const ScanSource& source, ScanPolygons& file)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size());
    const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!type.ok())
        return type.status().error_msg_string();

    draco::Decoder decoder;
    std::unique_ptr<draco::PointCloud> cloud;
    const draco::Mesh* mesh = nullptr;
    if (type.value() == draco::TRIANGULAR_MESH)
    {
        auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok())
            return decoded.status().error_msg_string();
        mesh = decoded.value().get();
        cloud = std::move(decoded).value();
    }
    else
    {
        auto decoded = decoder.DecodePointCloudFromBuffer(&buffer);
        if (!decoded.ok())
            return decoded.status().error_msg_string();
        cloud = std::move(decoded).value();
    }
    if (!readPositions(*cloud, file))
        return "the positions are missing or not finite";
    if (!readOthers(*cloud, file))
        return "the values of an attribute are damaged";
    for (uint32_t face = 0; mesh != nullptr && face < mesh->num_faces(); ++face)
    {
        for (const draco::PointIndex& point : mesh->face(draco::FaceIndex(face)))
        {
            if (point.value() >= cloud->num_points())
                return "index " + std::to_string(point.value()) + " of " +
                       std::to_string(cloud->num_points()) + " vertices";
            file.corner_positions.push_back(point.value());
        }
        file.face_ends.push_back(static_cast<uint32_t>(file.corner_positions.size()));
    }
    file.vertex_count = cloud->num_points();
    return {};
}

} // namespace

Result<ScanPolygons> readDrc(const ScanSource& source)
{
    const auto failure = [&](const std::string& reason) {
        return Error{Issue::codec_failed, source.path, "", "Draco: " + reason};
    };
    try
    {
        if (const std::optional<std::string> reason = findImpossibleDracoCount(source.bytes))
            return failure(*reason);
        ScanPolygons file;
        const std::string problem = decode(source, file);
        if (!problem.empty())
            return failure(problem);
        return file;
    }
    catch (const std::exception& exception) // damaged counts make the library ask for too much memory
    {
        return failure(exception.what());
    }
}

} // namespace hearth::import
