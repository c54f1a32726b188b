// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/built_in.h"

namespace hearth::profiles
{

namespace
{

// Settings for what a class of devices can hold and draw. Whether visibility and bricks are baked depends on
// the scene, or the project decides it.
constexpr std::string_view kText =
    R"(# Phones of the upper half: 2048 texels are one to a pixel at arm's length.
[profile.mobile-high]
clusters.normal_bits = 8
textures.max_size = 2048
bricks.memory = "20M"

# Phones with little memory. A group that keeps 40 % instead of half has fewer levels above it, and so less to store.
[profile.mobile-low]
inherits = "mobile-high"
clusters.levels = [{ keep = 0.4 }]
clusters.influences = 4
textures.max_size = 1024
textures.max_bits = 8
bricks.memory = "10M"

# Devices of OpenGL ES 3.0, which need not know ASTC.
[profile.gles3]
inherits = "mobile-low"
textures.families = ["etc2"]

# Memory to spare: textures as they are up to 4096, and more rays.
[profile.desktop]
textures.families = ["bc"]
textures.max_size = 4096
visibility.quality = "high"
bricks.memory = "64M"
)";

} // namespace

std::string_view builtInText()
{
    return kText;
}

const ConfigFile& builtInProfiles()
{
    static const ConfigFile file = parseConfig(kText, "built in", false).value();
    return file;
}

} // namespace hearth::profiles
