// Images of a cooked pack: runs hearth-render as a child process, on any Vulkan device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hearth::report
{

struct PackMesh
{
    uint32_t index = 0;
    std::string name;
};

/// Limits for images; meshes beyond them have none.
struct ImageLimits
{
    size_t meshes = 24;          ///< number of meshes; nobody looks at more
    double seconds = 120;        ///< no image is begun after this time
    uint64_t bytes = 8ull << 20; ///< size of all files, so that the page stays well below 20 MB
};

struct Images
{
    std::vector<std::string> views; ///< views of each list below: "final", ...
    std::vector<std::string> scene; ///< JPEG of the whole scene; empty where it could not be drawn
    bool is_sheet = false;          ///< the scene images are contact sheets: the assets are at one place
    std::map<uint32_t, std::vector<std::string>> meshes; ///< JPEG of each mesh alone, by mesh index
    size_t left_out = 0;                                 ///< number of meshes without images
    std::string why_left_out;
};

/// Progress callback, called before the first image is drawn and then at least once a second.
using ImageProgress = std::function<void(size_t drawn, size_t count)>;

/// Take the images of a pack.
/// meshes  most important first; meshes that the pack does not have under that index and name, or never
///         draws, are skipped
/// progress  callback; may be empty
Images renderImages(const std::string& pack, const std::vector<PackMesh>& meshes,
                    const ImageProgress& progress = {}, const ImageLimits& limits = {});

} // namespace hearth::report
