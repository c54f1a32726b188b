// Options of an import, and limits on untrusted sources. Every reader treats its bytes as hostile: it checks
// counts against the available bytes before it allocates or reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/dependency_list.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::import
{

class ImagesProgram;
struct FileProxies;

/// Largest coordinate of a position. Beyond it the squares of areas leave the range of floats in the cookers.
inline constexpr double kMaxCoordinate = 1e9;

/// Limits that keep a hostile file from exhausting the machine; generous for real assets.
struct ImportLimits
{
    uint64_t max_file_bytes = uint64_t{8} << 30;
    uint64_t max_vertices = uint64_t{1} << 28;     ///< for one mesh
    uint64_t max_triangles = uint64_t{1} << 28;    ///< for one mesh
    uint64_t max_image_texels = uint64_t{1} << 26; ///< 8192 x 8192: the largest that a mobile GPU can use
    uint32_t max_image_size = 16384;
    uint64_t max_instances = uint64_t{1} << 20;
};

/// Reading of images as artists' programs store them.
struct ArtistImages
{
    ImagesProgram* program = nullptr; ///< reads TIFF, PSD, JPEG 2000; null: such images are refused
    /// EXR: name of the part, or of the layer in a part, to read; empty: the first part with colours.
    std::string layer;
    /// Convert colours to sRGB by the image's ICC profile; CMYK is converted in any case.
    bool convert_icc = false;

    /// Return the same without conversion: for numbers that are no colours, and for glTF, which forbids it.
    ArtistImages withoutIcc() const { return {program, layer, false}; }
};

/// Treatment of the proxies that an artist made, which a source marks by their names or extras.
enum class AuthoredProxies : uint8_t
{
    kept,     ///< proxies of their meshes, not drawn
    left_out, ///< neither kept nor drawn
    unknown,  ///< drawn, as meshes like others
};

struct ImportOptions
{
    ImportLimits limits;
    ArtistImages artist;
    /// Edges sharper than this stay hard in a mesh without normals: 60 degrees.
    float crease_angle_rad = 1.0471976f;
    /// Size of the texels of baked light, in the source's unit of length, for which meshes get UVs that have
    /// none; 0: they get none.
    double receiver_texel_size = 0;
    /// Take the image-based light of a scene for the sky.
    bool takes_sky = true;
    AuthoredProxies proxies = AuthoredProxies::kept;
    /// Proxies from files, in place of those that the source has of the same mesh; null: none.
    const std::vector<FileProxies>* file_proxies = nullptr;
    tools::DependencyList* reads = nullptr; ///< records the files that are read; null: not recorded
};

} // namespace hearth::import
