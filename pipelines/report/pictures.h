// Pictures of what was cooked: hearth-render run as a child, on whatever Vulkan device there is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hearth::report
{

struct MeshOfPack
{
    uint32_t index = 0;
    std::string name;
};

/// What pictures may take; meshes beyond that have none.
struct PictureLimits
{
    size_t meshes = 24;          ///< a page of them; more are read by nobody
    double seconds = 120;        ///< no more are begun after it
    uint64_t bytes = 8ull << 20; ///< of all files, so that the page stays well below 20 MB
};

struct Pictures
{
    std::vector<std::string> views; ///< of each list below: "final", ...
    std::vector<std::string> scene; ///< JPEG of the whole scene; empty where it could not be drawn
    bool is_sheet = false;          ///< these are contact sheets: the assets stand in one place
    std::map<uint32_t, std::vector<std::string>> meshes; ///< the same of meshes, each alone
    size_t left_out = 0;                                 ///< meshes that have none
    std::string why_left_out;
};

/// Told before the first picture is drawn, and once a second or more often while they are.
using PicturesDrawn = std::function<void(size_t drawn, size_t count)>;

/// meshes  most important first; what the pack does not have under that number and name, or nowhere draws, is passed over
/// told    empty: is not
Pictures takePictures(const std::string& pack, const std::vector<MeshOfPack>& meshes,
                      const PicturesDrawn& told = {}, const PictureLimits& limits = {});

} // namespace hearth::report
