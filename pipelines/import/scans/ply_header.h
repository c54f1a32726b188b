// Reads the header of a PLY file. Source: G. Turk, "The PLY Polygon File Format", 1994, with the type names
// of later writers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/scans/scan_polygons.h"

namespace hearth::import
{

enum class PlyFormat : uint8_t
{
    ascii,
    little_endian,
    big_endian,
};

enum class PlyType : uint8_t
{
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    float32,
    float64,
};

constexpr uint32_t byteSize(PlyType type)
{
    constexpr uint32_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<size_t>(type)];
}

constexpr bool isFloat(PlyType type)
{
    return type == PlyType::float32 || type == PlyType::float64;
}

struct PlyProperty
{
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8; ///< type of a list's length
};

struct PlyElement
{
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader
{
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::string texture_file; ///< from the comment "TextureFile", as MeshLab writes it
    size_t body_offset = 0;
    size_t body_line = 0;
};

/// Parse the header of a file. errors: mesh_syntax, with the line.
Result<PlyHeader> readPlyHeader(const ScanSource& source);

} // namespace hearth::import
