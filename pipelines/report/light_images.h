// Pictures of the light that a pack has: its probes and its receivers. Needs no graphics device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>
#include <utility>
#include <vector>

namespace hearth::report
{

struct LightImage
{
    std::string name;
    std::string png;
    std::vector<std::pair<std::string, std::string>> facts; ///< name and value, in the order of the page
};

/// Number of probes that get a picture; a picture takes about 50 KB.
inline constexpr size_t kMaxProbeImages = 12;

/// Draw the first probes, each from the mip that is wide enough for a page, then the atlas of receivers.
/// pack  tables are valid
std::vector<LightImage> drawLight(const formats::PackView& pack);

/// Open a pack and draw its light; nothing for a file that is no valid pack.
std::vector<LightImage> drawLightOfPack(const std::string& path);

} // namespace hearth::report
